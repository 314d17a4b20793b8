// rhombloom connectors: small springy helpers for a lamp of hooked elements. Every part is one flat profile: print it
// lying, without supports (PETG or PP hold best), or cut it from 3 to 5 mm acrylic or plywood.
// The slots follow the thickness of the sheet and the sizes of the hook, so set those as in element.scad.

/* [What to make] */

// clip: holds a joint whose hook broke off. rivet: snaps into a node hole or a punched hole. holes: a row to test it
part = "all"; // [all:One of each, clip:Repair clip, rivet:Snap rivet, holes:Row of test holes]
// print: a solid for STL. cut: the flat profile for SVG or DXF
output = "print"; // [print:Solid to print, cut:Profile to cut]

/* [Element] */

// short side, node to node
la = 80; // [40:1:200]
// long side; 1.05 to 1.15 times la is usual, longer bows more
lb = 88; // [41:0.5:300]
// acute angle; 60, 63.435 and 69 suit most shapes
alpha = 63.435; // [50:0.005:80]
// of the sheet, measured
thickness = 0.5; // [0.2:0.05:0.8]

/* [Hook] */

// the slit is this much wider than the sheet is thick
slit_clearance = 0.3; // [0.1:0.05:1.5]
// automatic: all hook sizes follow la, thickness and slit_clearance. given: as the sliders below say
hook_sizes = "automatic"; // [automatic:Automatic, given:As given below]
// of finger and root: the master size, the other dimensions follow it
finger_width = 4.4; // [2:0.1:25]
// of the round opening at each node
hole_radius = 5.28; // [2:0.1:40]
// of its straight part; longer holds better and bends more easily
finger_length = 7.04; // [1:0.1:60]
// of finger and slit towards the element, about the slit's bottom
finger_turn = 0; // [0:0.5:15]
// how far the long side reaches over a rim
lip = 3.7; // [1:0.1:30]
// of the neck behind the nominal long side
neck_setback = 0.4; // [0:0.05:3]
// between shoulder and slit bottom
seat_clearance = 0.05; // [0:0.01:0.5]
// undercut that locks the joint against pulling; 0 for none, card wants 0.6 or more
barb = 0.528; // [0:0.05:5]
// radius of the long side's ends
lip_rounding = 1.54; // [0.3:0.05:10]
// of the soft curve between two hooks
scoop_depth = 8; // [0:0.5:60]
// radius in the corner between neck and shoulder; 0.3 for sheets that tear
relief = 0; // [0:0.05:2]

/* [Fit of the connectors] */

// slots are this much wider than the sheets they hold: less grips harder
play = 0.1; // [0:0.05:0.6]
// thickness of the walls that spring
wall = 1.6; // [0.8:0.1:4]

/* [Rivet] */

// diameter of the hole in mm; 0 takes the hole of a node
rivet_hole = 0; // [0:0.1:40]
// sheets on top of each other in the hole
rivet_layers = 2; // [1:1:4]

/* [Quality] */

// straight pieces of a full circle
segments = 64; // [32:8:256]

/* [Hidden] */

function need(met, name, value, remedy) = assert(met, str(name, " is ", value, ": ", remedy)) true;
function need_number(name, value, low, high, unit) =
    need(is_num(value) && value >= low && value <= high, name, value,
         str("set a number from ", low, " to ", high, " ", unit));

// ---- limits and proportions of the element (the same in every template) ----
sizes_in_range = [
    need_number("la", la, 40, 200, "mm"),
    need_number("lb", lb, 41, 300, "mm"),
    need_number("alpha", alpha, 50, 80, "deg"),
    need_number("thickness", thickness, 0.2, 0.8, "mm"),
    need_number("slit_clearance", slit_clearance, 0.1, 1.5, "mm"),
    need(hook_sizes == "automatic" || hook_sizes == "given", "hook_sizes", hook_sizes, "choose automatic or given"),
    need_number("finger_width", finger_width, 2, 25, "mm"),
    need_number("hole_radius", hole_radius, 2, 40, "mm"),
    need_number("finger_length", finger_length, 1, 60, "mm"),
    need_number("finger_turn", finger_turn, 0, 15, "deg"),
    need_number("lip", lip, 1, 30, "mm"),
    need_number("neck_setback", neck_setback, 0, 3, "mm"),
    need_number("seat_clearance", seat_clearance, 0, 0.5, "mm"),
    need_number("barb", barb, 0, 5, "mm"),
    need_number("lip_rounding", lip_rounding, 0.3, 10, "mm"),
    need_number("scoop_depth", scoop_depth, 0, 60, "mm"),
    need_number("relief", relief, 0, 2, "mm")];

automatic = hook_sizes == "automatic";
s = thickness + slit_clearance;
w = automatic ? max(3, 0.055 * la) : finger_width;
ri = automatic ? 1.2 * w : hole_radius;
e = automatic ? 1.6 * w : finger_length;
eta = automatic ? 0 : finger_turn;
m = automatic ? min(0.5 * thickness + 0.5 * slit_clearance + 0.75 * w, ri * sin(alpha) + w * sin(alpha) - w * cos(alpha) - 0.5 * thickness * cos(alpha) - 0.5 * slit_clearance * cos(alpha) - 0.31) : lip;
cn = automatic ? 0.5 * thickness + 0.5 * slit_clearance : neck_setback;
cs = automatic ? 0.05 : seat_clearance;
b = automatic ? 0.12 * w : barb;
rs = automatic ? 0.35 * w : lip_rounding;
q = automatic ? 0.1 * la : scoop_depth;
rc = automatic ? 0 : relief;

Rp = ri + w;                                // pivot radius: from a node to the bottom of the slit
neck = cn + rc;                             // depth of the neck
seat_turn = atan2(b, m - rs);               // the shoulder's concave corner turns by this much ...
seat_radius = b > 0 ? max(0.3, 0.2 + 0.06 / (seat_turn * PI / 180)) : 0; // ... with this radius
seat_tangent = seat_radius * tan(seat_turn / 2);
finger_d = [cos(eta), -sin(eta)];           // along the finger
finger_n = [sin(eta), cos(eta)];            // across it, outwards
pivot = [Rp + s / 2, 0];                    // middle of the slit's bottom
rim_end = pivot - s / 2 * finger_n + (e + w) * finger_d;

hook_fits = [
    need(lb > la, "lb", lb, str("the long side must be longer than la (", la, "); set lb to about ", 1.1 * la)),
    need(lb <= 1.5 * la, "lb", lb, str("the long side bows too far; set lb to at most 1.5 times la (", 1.5 * la, ")")),
    need(neck < ri * sin(alpha / 2), "neck_setback", cn,
         "neck and relief reach across the node hole; make neck_setback or relief smaller"),
    need(m > rs, "lip_rounding", rs, str("set it under lip (", m, ")")),
    need(b == 0 || (seat_tangent < cn && seat_tangent < m - rs), "barb", b,
         "it is too steep to be rounded; make barb smaller or neck_setback larger"),
    need(lb > 2 * (Rp + cs - b + rs), "finger_width", w,
         "the long side has no straight edge left; make finger_width or hole_radius smaller"),
    need((Rp + s / 2) * sin(alpha) > s / 2 + neck + 1, "finger_width", w,
         "slit and long side come too near; make finger_width or hole_radius larger or slit_clearance smaller"),
    need(la - 2 * rim_end.x > 1, "finger_length", e,
         "no room is left for the soft curve; make finger_length or finger_width smaller"),
    need(q >= -rim_end.y, "scoop_depth", q, str("the rims are deeper; set it to at least ", -rim_end.y)),
    need(q < lb * sin(alpha) / 2 - 1, "scoop_depth", q,
         str("the two soft curves meet; set it under ", lb * sin(alpha) / 2 - 1))];
// ---- end of limits and proportions ----

// ---- profiles that hold a sheet (the same in every template) ----
connector_in_range = [
    need(output == "cut" || output == "print", "output", output, "choose cut or print"),
    need_number("play", play, 0, 0.6, "mm"),
    need_number("wall", wall, 0.8, 4, "mm"),
    need_number("segments", segments, 32, 256, "pieces")];

// Solid of the height, or the bare profile.
module made(height) {
    if (output == "cut") {
        children();
    } else {
        linear_extrude(height = height) children();
    }
}

// What the part holds, to be seen in the preview (F5) only; never exported.
module held() {
    if ($preview && output == "print") {
        %children();
    }
}

// Sheets with a round hole, seen from the edge: wings go through them along +y.
module held_sheets(hole, stack, height) {
    held() translate([0, 0, height / 2]) rotate([-90, 0, 0]) linear_extrude(height = stack) difference() {
        circle(d = 2.2 * hole, $fn = segments);
        circle(d = hole, $fn = segments);
    }
}

// Convex corners rounded; slots keep their width.
module rounded(r) {
    offset(r = r, $fn = segments) offset(delta = -r) children();
}

// Two walls along +x from the origin, the slot between them centred on the axis.
module jaw(slot, depth) {
    difference() {
        translate([-wall, -slot / 2 - wall]) square([depth + wall, slot + 2 * wall]);
        translate([0, -slot / 2]) square([depth + 1, slot]);
    }
}

// Wings that fold when pushed through a round hole and open behind the sheets: along +y from a shoulder at y = 0.
function wing_wall(hole) = min(1.2, 0.16 * hole);
function wing_height(hole) = 0.5 * (hole - play);                                // of the solid, so that it passes
function wing_width(hole) = sqrt(pow(hole - play, 2) - pow(wing_height(hole), 2)); // the round hole
function wing_catch(hole) = hole / 2 + 0.3 + 0.04 * hole;                        // half the span behind the sheets
function wing_length(hole) = sqrt(60 * wing_wall(hole) * (wing_catch(hole) - wing_width(hole) / 2)); // strain 2.5 %
module wings(hole, stack) {
    t = wing_wall(hole);
    tip = stack + wing_length(hole);
    post = max(0.8, wing_width(hole) - 2 * t - 2 * wing_catch(hole) * 0.15);
    rounded(0.2) for (side = [-1, 1]) scale([side, 1]) polygon([
        [-0.01, -0.5], [post / 2, -0.5], [post / 2, tip - 1.6 * t], [wing_catch(hole) - t, stack],
        [wing_catch(hole), stack], [wing_catch(hole), stack + 0.6 * t], [post / 2, tip], [-0.01, tip + t]]);
}
// ---- end of profiles ----

rivet_in_range = [
    need(part == "all" || part == "clip" || part == "rivet" || part == "holes", "part", part,
         "choose all, clip, rivet or holes"),
    need(is_num(rivet_hole) && (rivet_hole == 0 || (rivet_hole >= 3 && rivet_hole <= 40)), "rivet_hole", rivet_hole,
         "set 0 for the node hole or a diameter from 3 to 40 mm"),
    need(is_num(rivet_layers) && rivet_layers == floor(rivet_layers) && rivet_layers >= 1 && rivet_layers <= 4,
         "rivet_layers", rivet_layers, "set a whole number from 1 to 4")];

// ---- repair clip, seen along the broken hook's side: x from the node along the edge, y out of the lamp ----
// One slot grips the element with the broken hook from its node hole and catches the end of its rim; the other slot
// takes the shoulder of the bowed long side at the angle at which it leaves.
slot = thickness + play;
clip_width = min(m, 0.8 * ri);

function bow_angle(ratio, low = 0, high = 180, steps = 40) = let (mid = (low + high) / 2)
    steps == 0 ? mid : sin(mid) / (mid * PI / 180) > ratio ? bow_angle(ratio, mid, high, steps - 1)
                                                          : bow_angle(ratio, low, mid, steps - 1);
phi = bow_angle((la - 2 * Rp) / (lb - 2 * Rp));
bow_radius = (lb - 2 * Rp) / (2 * phi * PI / 180);
jaw_depth = min(0.8 * e, sqrt(8 * bow_radius * max(play, 0.1))); // no deeper than the bow is nearly straight
jaw_angle = phi - jaw_depth / bow_radius / 2 * 180 / PI;

// Where the soft curve is as deep as the clip is wide.
function scoop_u(t) = let (run = 0.35 * (la - 2 * rim_end.x)) rim_end.x * (1 - t) * (1 - t) * (1 - t)
    + 3 * (rim_end.x + run) * (1 - t) * (1 - t) * t + 3 * (la - rim_end.x - run) * (1 - t) * t * t
    + (la - rim_end.x) * t * t * t;
function scoop_o(t) = rim_end.y - 4 * (q + rim_end.y) * (1 - t) * t;
function scoop_t(depth) = (1 - sqrt(max(0, 1 - (depth + rim_end.y) / (q + rim_end.y)))) / 2;

clip_fits = need(part == "rivet" || part == "holes" || q > clip_width + 0.5, "scoop_depth", q,
    str("the repair clip finds no end of the rim; set scoop_depth over ", clip_width + 0.5, " or part to rivet"));

floor_x = sqrt(ri * ri - clip_width * clip_width) - play;
tooth_x = clip_width < q ? scoop_u(scoop_t(clip_width)) + play : la / 2;
jaw_y = slot + wall * sin(jaw_angle) + (slot / 2 + wall) * cos(jaw_angle);

module repair_clip() {
    rounded(0.25) {
        translate([floor_x - wall, -wall]) square([wall, slot + 2 * wall]);
        translate([floor_x - wall, -wall]) square([tooth_x - floor_x + wall, wall]);
        hull() {
            translate([floor_x - wall, slot]) square([Rp - floor_x + wall, wall]);
            translate([Rp, jaw_y]) rotate(jaw_angle) translate([-wall, -slot / 2 - wall]) square([wall, slot + 2 * wall]);
        }
        translate([Rp, jaw_y]) rotate(jaw_angle) jaw(slot, jaw_depth);
        polygon([[tooth_x - 0.01, -wall], [tooth_x - 0.01, 0], [tooth_x, thickness], [tooth_x + 0.5 * wall, thickness],
                 [tooth_x + 2 * wall, -wall]]);
    }
}

// The element with the broken hook, flat, and the bowed long side, from the shoulder on.
function bow_points(r, length, n = 24) = [for (i = [0 : n])
    let (a = phi - length / r * 180 / PI * i / n) [Rp, jaw_y] + r * [sin(phi) - sin(a), cos(a) - cos(phi)]];
module held_edges() {
    side = bow_points(bow_radius, 0.45 * (lb - 2 * Rp));
    translate([floor_x + play, 0]) square([tooth_x - floor_x - 2 * play, thickness]);
    for (i = [1 : len(side) - 1]) hull() for (p = [side[i - 1], side[i]]) translate(p) circle(d = thickness, $fn = 12);
}
// ---- end of repair clip ----

hole = rivet_hole == 0 ? 2 * ri : rivet_hole;

module rivet() {
    wings(hole, rivet_layers * thickness + play);
    rounded(0.4) translate([-0.8 * hole, -wall]) square([1.6 * hole, wall]);
}

// Five holes in steps of 0.1 mm, the middle one as set; one to five notches below.
module test_holes() {
    pitch = max(hole + 4, 12);
    difference() {
        rounded(2) square([5 * pitch, hole + 8]);
        for (k = [0 : 4]) translate([(k + 0.5) * pitch, 0]) {
            translate([0, hole / 2 + 5]) circle(d = (hole + (k - 2) * 0.1) / cos(180 / segments), $fn = segments);
            for (i = [0 : k]) translate([1.8 * (i - k / 2), 0]) circle(r = 0.6, $fn = 16);
        }
    }
}

if (part == "all" || part == "clip") {
    made(clip_width - 0.2) repair_clip();
    held() translate([0, 0, -clip_width]) linear_extrude(height = 3 * clip_width) held_edges();
}
if (part == "all" || part == "rivet") {
    translate([part == "all" ? hole : 0, part == "all" ? -wing_length(hole) - 12 : 0]) {
        made(wing_height(hole)) rivet();
        held_sheets(hole, rivet_layers * thickness, wing_height(hole));
    }
}
if (part == "all" || part == "holes") {
    translate([part == "all" ? 2.5 * hole : 0, part == "all" ? -hole - 22 : 0]) made(rivet_layers * thickness) test_holes();
}

echo(str("connectors: slot ", slot, " mm, clip ", clip_width - 0.2, " mm wide for a bow of ", phi,
         " deg, rivet for a hole of ", hole, " mm and ", rivet_layers, " sheets"));
