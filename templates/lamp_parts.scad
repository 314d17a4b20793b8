// rhombloom lamp parts: holds the socket, hangs the lamp, lets it stand. Every part is one flat profile: print it
// lying, without supports (PETG or ASA near a bulb), or cut it from plywood or acrylic as thick as plate says.
// The slots follow the thickness of the sheet and the sizes of the hook, so set those as in element.scad.
// LED only, at most 8 W, the bulb at least 30 mm from the sheet. A certified pendant cord carries the lamp.

/* [What to make] */

// ring, cap: take the place of one element, held by edge clips. hanger: snaps into a node hole. stand: make two
part = "hanger"; // [hanger:Hanging ring, ring:Ring for a socket, cap:Cap with cord and vents, edge_clip:Edge clip for ring and cap, cord_lock:Strain relief for the cord, stand:Small stand]
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

/* [Fit of the lamp parts] */

// thickness of the plates: ring, cap, cord lock, hanger and stand
plate = 3; // [2:0.1:6]
// slots are this much wider than what they hold: less grips harder
play = 0.1; // [0:0.05:0.6]
// thickness of the walls that spring
wall = 1.6; // [0.8:0.1:4]
// angle between the plate and the sheet at an edge clip, in degrees
edge_angle = 20; // [-60:5:60]

/* [Socket and cord] */

// thread that the ring's bore lets through
socket = "e27"; // [e27:E27 with 40 mm bore, e14:E14 with 29 mm bore, other:UNO or other with the bore below]
// bore in mm for UNO and other sockets: measure yours
bore = 41.5; // [15:0.5:80]
// diameter of the cord
cord = 6.5; // [3:0.1:10]

/* [Stand] */

// radius of the lamp in mm; 0 takes the ball of 30 elements
lamp_radius = 0; // [0:1:600]
// width of the stand
stand_width = 130; // [60:5:220]

/* [Quality] */

// straight pieces of a full circle
segments = 96; // [32:8:256]

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

parts = ["ring", "cap", "edge_clip", "cord_lock", "hanger", "stand"];
lamp_in_range = [
    need(len([for (p = parts) if (p == part) p]) == 1, "part", part, "choose ring, cap, edge_clip, cord_lock, hanger or stand"),
    need_number("plate", plate, 2, 6, "mm"),
    need_number("edge_angle", edge_angle, -60, 60, "deg"),
    need(socket == "e27" || socket == "e14" || socket == "other", "socket", socket, "choose e27, e14 or other"),
    need_number("bore", bore, 15, 80, "mm"),
    need_number("cord", cord, 3, 10, "mm"),
    need_number("lamp_radius", lamp_radius, 0, 600, "mm"),
    need_number("stand_width", stand_width, 60, 220, "mm")];

module hole(d) {
    circle(d = d / cos(180 / segments), $fn = segments); // round the circle, so that the hole is not too small
}

// ---- ring and cap, in the opening that one left-out element makes ----
// Its long sides are the neighbours' short sides with their soft curves, its short sides the neighbours' lips.
jaw_depth = 6;
clip_width = 6;
tongue_width = clip_width + 4;
socket_bore = socket == "e27" ? 40.5 : socket == "e14" ? 29.5 : bore;
is_round = part == "ring" || part == "cap";
round_radius = part == "ring" ? socket_bore / 2 + 4 : max(cord * 2.6 + 8, 16);
to_curve = la * sin(alpha) / 2 + q - 1.5 * wall; // where the tongues end
to_lip = lb * sin(alpha) / 2 - m - 1.5 * wall;
tongue = jaw_depth + 1;
four_tongues = to_lip > round_radius + tongue;

ring_fits = [
    need(!is_round || round_radius < to_lip + 1.5 * wall - 0.5, "part", part,
         str("a ", part, " of ", 2 * round_radius, " mm does not fit the opening of one element (",
             2 * to_lip, " mm); choose a smaller socket or cord, a larger la or the hanger")),
    need(!is_round || round_radius + tongue / 2 < to_curve, "part", part,
         str("no room for the tongues of a ", part, " of ", 2 * round_radius,
             " mm; choose a smaller socket or cord, a larger la or the hanger"))];

// From the round plate towards a side's middle; the tongue stands square to the side.
module arm(middle, normal, reach) {
    end = middle + (reach - middle * normal) * normal;
    angle = atan2(normal.y, normal.x);
    hull() {
        translate(end * (round_radius - 3) / norm(end)) circle(r = tongue_width / 2, $fn = segments);
        translate(end) rotate(angle) translate([-tongue - 1, -tongue_width / 2]) square([1, tongue_width]);
    }
    translate(end) rotate(angle) translate([-tongue - 1, -tongue_width / 2]) square([tongue + 1, tongue_width]);
}

// Where the edge clip's tooth drops in.
module window(middle, normal, reach) {
    translate(middle + (reach - middle * normal) * normal) rotate(atan2(normal.y, normal.x))
        translate([-jaw_depth / 2 - 0.2, 0]) square([2.4, clip_width + 0.6], center = true);
}

module at_sides() {
    for (side = [-1, 1]) {
        $normal = [0, side];
        $middle = side * la / 2 * [cos(alpha), sin(alpha)];
        $reach = to_curve;
        children();
    }
    if (four_tongues) for (side = [-1, 1]) {
        $normal = side * [sin(alpha), -cos(alpha)];
        $middle = side * [lb / 2, 0];
        $reach = to_lip;
        children();
    }
}

module round_plate() {
    difference() {
        offset(r = -1.5, $fn = segments) offset(delta = 1.5) union() { // soft inner corners
            circle(r = round_radius, $fn = segments);
            at_sides() arm($middle, $normal, $reach);
        }
        at_sides() window($middle, $normal, $reach);
        children();
    }
}

module ring() {
    round_plate() hole(socket_bore);
}

// The cord weaves through three holes, so that it cannot slip; the vents let the heat out.
module cord_holes() {
    for (x = [-1 : 1]) translate([x * (cord + 2.5), 0]) hole(cord + 0.5);
}

module cap() {
    vent = round_radius * 0.26;
    round_plate() {
        cord_holes();
        for (a = [50, 90, 130, 230, 270, 310]) rotate(a) translate([round_radius - vent - 2.5, 0]) scale([1.6, 1])
            circle(d = vent, $fn = segments);
    }
}

module cord_lock() {
    difference() {
        hull() for (side = [-1, 1]) translate([side * (cord + 2.5), 0]) circle(d = cord + 7, $fn = segments);
        cord_holes();
    }
}

// One slot for the plate, with a tooth for its window, one for the sheet, with two bumps that grip.
module edge_clip() {
    plate_slot = plate + play;
    sheet_slot = thickness + play;
    rounded(0.3) {
        hull() {
            rotate(180) jaw_back(plate_slot);
            rotate(edge_angle) translate([1.5 * wall, 0]) jaw_back(sheet_slot);
        }
        rotate(180) jaw(plate_slot, jaw_depth);
        rotate(edge_angle) translate([1.5 * wall, 0]) jaw(sheet_slot, jaw_depth);
        translate([-jaw_depth / 2, -plate_slot / 2]) polygon([[-1.2, -0.1], [0.8, -0.1], [0.8, 0.8], [0.2, 0.8]]);
        rotate(edge_angle) translate([1.5 * wall, 0]) for (side = [-1, 1])
            translate([jaw_depth * (0.6 - 0.15 * side), side * (sheet_slot / 2 + 0.6 - play)]) circle(r = 0.6, $fn = 32);
    }
}
module jaw_back(slot) {
    translate([-wall, -slot / 2 - wall]) square([wall, slot + 2 * wall]);
}

// ---- hanging ring: wings below, an eye above; two layers of sheet between them ----
module hanger() {
    wings(2 * ri, 2 * thickness + play);
    difference() {
        rounded(0.5) hull() {
            translate([-1.5 * ri, -2]) square([3 * ri, 2]);
            translate([0, -12]) circle(r = 9, $fn = segments);
        }
        translate([0, -12]) circle(r = 5.5, $fn = segments);
    }
}

// ---- stand: two profiles that cross in half laps; the slots in the tips take the edge of a bowed long side ----
ball_radius = lamp_radius == 0 ? 1.57 * la : lamp_radius;
stand_fits = need(part != "stand" || stand_width < 1.6 * ball_radius, "stand_width", stand_width,
    str("the lamp (radius ", ball_radius, " mm) is too small for it; set stand_width under ", 1.6 * ball_radius));
stand_base = 14;   // height of the profile in the middle
module stand_profile(up) {
    half = asin(stand_width / 2 / ball_radius);
    top = stand_base + ball_radius * (1 - cos(half));
    lap = plate + play;
    difference() {
        rounded(1.5) difference() {
            translate([-stand_width / 2 - 6, 0]) square([stand_width + 12, top]);
            translate([0, stand_base + ball_radius]) circle(r = ball_radius, $fn = 4 * segments);
            translate([0, -ball_radius]) circle(r = ball_radius + 3, $fn = 4 * segments);
        }
        translate([-lap / 2, up ? (stand_base + 3) / 2 : -1]) square([lap, up ? stand_base : (stand_base + 3) / 2 + 1]);
        for (side = [-1, 1]) scale([side, 1]) translate([0, stand_base + ball_radius]) rotate(half * 0.85)
            translate([0, -ball_radius]) rotate(-edge_angle) translate([-(thickness + play) / 2, -m - 1])
                square([thickness + play, m + 3]);
    }
}

module stand() {
    stand_profile(true);
    translate([0, -stand_base - ball_radius * (1 - cos(asin(stand_width / 2 / ball_radius))) - 6]) stand_profile(false);
}

// The edges that ring and cap reach for: soft curves and lips of the four neighbours.
module held_neighbours() {
    for (side = [-1, 1]) scale(side) {
        v = la / 2 * [cos(alpha), sin(alpha)];
        translate(v) difference() {
            translate([-lb / 2 + Rp, 0]) square([lb - 2 * Rp, q + 2 * w]);
            scale([1, 2 * q / (la - 2 * rim_end.x)]) circle(d = la - 2 * rim_end.x, $fn = segments);
        }
        translate([lb / 2, 0]) rotate(alpha) translate([-la / 2 + Rp, -2 * w]) square([la - 2 * Rp, 2 * w + m]);
    }
}

if (part == "ring" || part == "cap") {
    made(plate) if (part == "ring") ring(); else cap();
    held() translate([0, 0, plate / 2]) linear_extrude(height = thickness) held_neighbours();
} else if (part == "edge_clip") {
    made(clip_width) edge_clip();
    held() translate([0, 0, -clip_width]) linear_extrude(height = 3 * clip_width) {
        translate([-16, -plate / 2]) square([16, plate]);
        rotate(edge_angle) translate([1.5 * wall, -thickness / 2]) square([18, thickness]);
    }
} else if (part == "cord_lock") {
    made(plate) cord_lock();
} else if (part == "hanger") {
    made(max(plate, wing_height(2 * ri))) hanger();
    held_sheets(2 * ri, 2 * thickness, max(plate, wing_height(2 * ri)));
} else {
    made(plate) stand();
    held() translate([0, stand_base + ball_radius, plate / 2]) intersection() { // the bottom of the lamp
        sphere(r = ball_radius - 0.5, $fn = 96);
        translate([0, -1.35 * ball_radius, 0]) cube([2 * ball_radius, ball_radius, stand_width], center = true);
    }
}

echo(part == "ring" ? str("ring: bore ", socket_bore, " mm, ", four_tongues ? 4 : 2, " edge clips") :
     part == "cap" ? str("cap: cord ", cord, " mm, ", four_tongues ? 4 : 2, " edge clips") :
     part == "edge_clip" ? str("edge clip: slots ", thickness + play, " and ", plate + play, " mm, ", clip_width, " mm wide") :
     part == "hanger" ? str("hanger: for a node hole of ", 2 * ri, " mm and two sheets of ", thickness, " mm") :
     part == "stand" ? str("stand: for a lamp of radius ", ball_radius, " mm") : str("cord lock: cord ", cord, " mm"));
