// rhombloom fit coupon: ten minutes that save a sheet. Cut it first, from the sheet you will use.
// Joint: two strips with real hooks; hook the long strip into the short one, it must bow, hold and come off again.
// Ladder: slits in steps, counted by the notches below them. Push an edge of the sheet into each: the narrowest that
// takes it without force is yours; the console lists their widths. Set slit_clearance to that width minus thickness.

/* [What to make] */

// cut: an outline for SVG or DXF (laser, knife). print: a flat solid for STL
output = "cut"; // [cut:Outline to cut, print:Solid to print]
// what the coupon consists of
part = "all"; // [all:Joint and ladder, joint:Two strips that hook together, ladder:Ladder of slits]

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

/* [Cut] */

// FULL width of the cut; 0 when the machine's program compensates
kerf = 0; // [0:0.01:1]
// width of the cut measured along y, when it differs
kerf_y = 0; // [0:0.01:1]

/* [Ladder] */

// number of slits
ladder_slits = 7; // [3:1:9]
// from one slit to the next
ladder_step = 0.05; // [0.02:0.01:0.3]

/* [Printing] */

// the print is a whole number of these layers thick
layer_height = 0.1; // [0.04:0.01:0.4]

/* [Quality] */

// straight pieces of a full circle; 128 at most in a print. The size of the part stays the same
segments = 720; // [32:8:1080]

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

// ---- outline of the element: the steps of exporters/outline.h, point by point ----
// A vertex is [x, y, bulge]; bulge = tan(sweep / 4) of the arc that follows, 0 for a straight line.
scoop_biarcs = 12;

function dot(p, v) = p.x * v.x + p.y * v.y;
function unit(v) = v / norm(v);
function at(p, bulge) = [p.x, p.y, bulge];

// Half a side, then its mirror image u -> length - u in reverse order.
function with_mirror_image(half, length) =
    concat(half, [for (i = [len(half) - 1 : -1 : 0])
        [length - half[i].x, half[i].y, i > 0 ? half[i - 1].z : 0]]);

function seat(shoulder) = b == 0 ? [] : [
    [shoulder, -seat_tangent, -tan(seat_turn / 4)],
    [shoulder - seat_tangent * sin(seat_turn), seat_tangent * cos(seat_turn), 0]];
function half_long_side(shoulder) = concat(
    [[sqrt(ri * ri - neck * neck), -neck, 0]],
    rc > 0 ? [[shoulder - rc, -neck, -tan(22.5)]] : [],
    [[shoulder, -cn, 0]],
    seat(shoulder),
    [[shoulder - b, m - rs, tan(22.5)], [shoulder - b + rs, m, 0]]);
function long_side() = with_mirror_image(half_long_side(Rp + cs), lb);

function half_short_side() = let (tip = pivot + e * finger_d, outer = (s / 2 + w) * finger_n, inner = s / 2 * finger_n) [
    [ri, 0, tan((90 + eta) / 4)],
    at(pivot + outer, 0),
    at(tip + outer, 1),
    at(tip + inner, 0),
    at(pivot + inner, -1),
    at(pivot - inner, 0)];

// The scoop: a cubic, cut as pairs of arcs that meet where their tangents are equally long.
function cubic(c, t) = (1 - t) * (1 - t) * (1 - t) * c[0] + 3 * (1 - t) * (1 - t) * t * c[1]
    + 3 * (1 - t) * t * t * c[2] + t * t * t * c[3];
function cubic_tangent(c, t) =
    unit((1 - t) * (1 - t) * (c[1] - c[0]) + 2 * (1 - t) * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
function bulge_from_tangent(tangent, chord) =
    (tangent.x * chord.y - tangent.y * chord.x) / (norm(chord) + dot(tangent, chord));
function biarc(p, p_tangent, r, r_tangent) =
    let (v = r - p, x = dot(v, p_tangent + r_tangent),
         l = dot(v, v) / (x + sqrt(x * x + 2 * (1 - dot(p_tangent, r_tangent)) * dot(v, v))),
         middle = (p + l * p_tangent + r - l * r_tangent) / 2)
    [at(p, -bulge_from_tangent(p_tangent, middle - p)),
     at(middle, -bulge_from_tangent(unit(v - l * (p_tangent + r_tangent)), r - middle))];
function scoop(start, end) =
    let (run = 0.35 * (end.x - start.x), depth = (q + start.y) / 0.75,
         c = [start, start + [run, -depth], end - [run, depth], end])
    [for (i = [0 : scoop_biarcs - 1], v = let (t = i / scoop_biarcs, u = (i + 1) / scoop_biarcs)
        biarc(cubic(c, t), cubic_tangent(c, t), cubic(c, u), cubic_tangent(c, u))) v];
function short_side() =
    let (half = half_short_side(), both = with_mirror_image(half, la), end = [la - rim_end.x, rim_end.y])
    concat(half, scoop(rim_end, end), [at(end, 0)], [for (i = [len(half) : len(both) - 1]) both[i]]);

// A side's frame: u along it, o outwards (to the right). Its last vertex starts the arc round the next node.
function placed_side(side, origin, u, hole_bulge) = [for (i = [0 : len(side) - 1])
    at(origin + side[i].x * u + side[i].y * [u.y, -u.x], i < len(side) - 1 ? side[i].z : hole_bulge)];
function hole_bulge(corner) = -tan((corner - asin(neck / ri)) / 4);
function without_repeats(path) = [for (i = [0 : len(path) - 1])
    let (step = path[(i + 1) % len(path)] - path[i]) if (norm([step.x, step.y]) > 1e-9) path[i]];

// The contour, counter-clockwise: corner v0 (acute) in the origin, the long side v0-v1 on the x axis.
function element_path() =
    let (u = [1, 0], v = [cos(alpha), sin(alpha)], long = long_side(), short = short_side(),
         obtuse = hole_bulge(180 - alpha), acute = hole_bulge(alpha))
    without_repeats(concat(
        placed_side(long, [0, 0], u, obtuse),
        placed_side(short, lb * u, v, acute),
        placed_side(long, lb * u + la * v, -u, obtuse),
        placed_side(short, la * v, -v, acute)));

// Every arc in equal pieces; the closing point is not repeated.
fineness = output == "cut" ? segments : min(segments, 128);
function arc_pieces(sweep) = max(ceil(fineness / 32), ceil(fineness * abs(sweep) / 360 - 1e-9));
function turned(v, angle) = [cos(angle) * v.x - sin(angle) * v.y, sin(angle) * v.x + cos(angle) * v.y];
function arc_points(p, chord, sweep) = let (n = arc_pieces(sweep)) [for (k = [0 : n - 1])
    p + turned(chord, -(1 - k / n) * sweep / 2) * (sin(k / n * sweep / 2) / sin(sweep / 2))];
function path_points(path) = [for (i = [0 : len(path) - 1],
    p = let (start = [path[i].x, path[i].y], next = path[(i + 1) % len(path)])
        path[i].z == 0 ? [start] : arc_points(start, [next.x, next.y] - start, 4 * atan(path[i].z))) p];
function element_points() = path_points(element_path());

function sum(v, i = 0, total = 0) = i < len(v) ? sum(v, i + 1, total + v[i]) : total;
function area(points) = sum([for (i = [0 : len(points) - 1])
    let (p = points[i], r = points[(i + 1) % len(points)]) (p.x * r.y - p.y * r.x) / 2]);
function cut_length(points) = sum([for (i = [0 : len(points) - 1]) norm(points[(i + 1) % len(points)] - points[i])]);
// ---- end of outline ----

// ---- sheet: the flat piece, as an outline to cut or a solid to print ----
sheet_in_range = [
    need(output == "cut" || output == "print", "output", output, "choose cut or print"),
    need_number("segments", segments, 32, 1080, "pieces"),
    need_number("kerf", kerf, 0, 1, "mm"),
    need_number("kerf_y", kerf_y, 0, 1, "mm"),
    need(max(kerf, kerf_y) < s - 0.05, kerf < kerf_y ? "kerf_y" : "kerf", max(kerf, kerf_y),
         str("the cut closes the slit (", s, " mm); set kerf under ", s - 0.05, " or make slit_clearance larger")),
    need_number("layer_height", layer_height, 0.04, 0.4, "mm")];

printed = max(1, round(thickness / layer_height)) * layer_height; // thickness of the print
print_fits = need(output == "cut" || printed < s - 0.05, "layer_height", layer_height,
    str("whole layers make the print ", printed, " mm thick, too much for the slit (", s, "); set thinner layers"));

// The edge moves out by half the kerf, so that the finished edge is the drawn one. kerf_y = 0 means: as kerf.
module cut() {
    kx = max(kerf, 0.005);
    ky = kerf_y == 0 ? kx : max(kerf_y, 0.005);
    if (kerf == 0 && kerf_y == 0) {
        children();
    } else {
        scale([min(1, kx / ky), min(1, ky / kx)]) offset(r = max(kx, ky) / 2, $fn = fineness)
            scale([max(1, ky / kx), max(1, kx / ky)]) children();
    }
}

module sheet() {
    if (output == "cut") {
        cut() children();
    } else {
        linear_extrude(height = printed) children();
    }
}
// ---- end of sheet ----

coupon_in_range = [
    need(part == "all" || part == "joint" || part == "ladder", "part", part, "choose all, joint or ladder"),
    need(is_num(ladder_slits) && ladder_slits == floor(ladder_slits) && ladder_slits >= 3 && ladder_slits <= 9,
         "ladder_slits", ladder_slits, "set a whole number from 3 to 9"),
    need_number("ladder_step", ladder_step, 0.02, 0.3, "mm")];

gap = 3;       // between the pieces
corner = 2;    // rounding of their outer corners
round_corner = tan(22.5);

// A strip behind one side of the element: the side's own points, a quarter of the hole at each node, a straight back.
function strip(side, length, depth, hole) = without_repeats(concat(
    placed_side(side, [0, 0], [1, 0], hole),
    [[length, ri, 0], [length, depth - corner, round_corner], [length - corner, depth, 0],
     [corner, depth, round_corner], [0, depth - corner, 0], [0, ri, hole]]));

short_depth = q + 2.5 * w;
long_depth = ri + 2 * w;
function short_strip() = strip(short_side(), la, short_depth, hole_arc(0));
function long_strip() = strip(long_side(), lb, long_depth, hole_arc(neck));
function hole_arc(depth) = -tan((90 - asin(depth / ri)) / 4);

// The ladder, slits up. A slit has the hook's depth and round bottom; k notches below the k-th.
ladder_depth = e + w;
ladder_height = ladder_depth + 7;
notch = 0.7;   // radius
pitch = 2.6 * notch * ladder_slits + 4;
ladder_length = pitch * ladder_slits;
narrowest = max(s - floor(ladder_slits / 2) * ladder_step, max(kerf, kerf_y) + 0.1);
function slit_width(k) = narrowest + (k - 1) * ladder_step;
function ladder_slit(x, width) = [
    [x + width / 2, ladder_height, 0], [x + width / 2, ladder_height - ladder_depth + width / 2, -1],
    [x - width / 2, ladder_height - ladder_depth + width / 2, 0], [x - width / 2, ladder_height, 0]];
function ladder_notches(x, count) = [for (i = [0 : count - 1], side = [-1, 1])
    [x + 2.6 * notch * (i - (count - 1) / 2) + side * notch, 0, side < 0 ? -1 : 0]];
function ladder_path() = concat(
    [[corner, 0, 0]],
    [for (k = [1 : ladder_slits], v = ladder_notches((k - 0.5) * pitch, k)) v],
    [[ladder_length - corner, 0, round_corner], [ladder_length, corner, 0],
     [ladder_length, ladder_height - corner, round_corner], [ladder_length - corner, ladder_height, 0]],
    [for (k = [ladder_slits : -1 : 1], v = ladder_slit((k - 0.5) * pitch, slit_width(k))) v],
    [[corner, ladder_height, round_corner], [0, ladder_height - corner, 0], [0, corner, round_corner]]);

module outline_of(path) {
    polygon(path_points(path));
}

module joint() {
    outline_of(short_strip());
    translate([0, short_depth + m + gap]) outline_of(long_strip());
}

sheet() {
    if (part != "ladder") {
        joint();
    }
    if (part != "joint") {
        translate([0, part == "all" ? short_depth + m + long_depth + 2 * gap : 0]) outline_of(ladder_path());
    }
}

echo(str("fit coupon: joint with slit ", s, " mm; slits of the ladder by their notches:",
         [for (k = [1 : ladder_slits]) str(" ", k, ": ", slit_width(k), " mm")]));
