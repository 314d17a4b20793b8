// rhombloom element: the one flexible piece of a puzzle lamp, a rhomboid with four hooks.
// Cut it from thin springy sheet or print it flat; many copies hook together, no glue.
// Opens in OpenSCAD 2021.01 and later, needs no library. Window > Customizer shows the sliders.
// Try the joint first: fit_coupon.scad.

/* [What to make] */

// Cut: a flat outline for SVG or DXF. Print: a solid for STL. Pair: two pieces side by side, to cut a first joint.
part = "cut"; // [cut:Outline to cut, print:Solid to print, pair:Two outlines to cut]

/* [Element] */

// Short side la in mm, from node to node. It sets the size of the lamp.
la = 80; // [20:1:300]
// Long side lb in mm: it bows out between the hooks and makes the tension. Usual is 1.1 times la.
lb = 88; // [21:0.5:450]
// Acute angle in degrees. 63.435 makes a ball of 30, 60 and 69 are the other usual ones.
alpha = 63.435; // [50:0.005:80]
// Thickness of the sheet in mm. Measure it.
thickness = 0.5; // [0.1:0.05:2]

/* [Fit] */

// Width of the slit in mm, as it shall be after cutting: thickness plus play. The coupon tells you the best.
slit = 0.8; // [0.15:0.05:4]
// Full width that the cutter burns away, in mm. 0 when the cutter's own program corrects it.
kerf = 0; // [0:0.01:0.5]

/* [Hook] */

// Width of the finger in mm: the size of the whole hook.
finger_width = 4.4; // [1.5:0.1:20]
// Length of the straight finger in mm. Longer holds better and bends more when hooking.
finger_length = 7.04; // [0:0.1:40]
// Finger turned towards the element, in degrees.
finger_turn = 0; // [-15:1:30]
// Radius of the hole round each node in mm.
hole_radius = 5.28; // [1.5:0.1:30]
// How far the long side stands out over the line from node to node, in mm.
lip = 3.7; // [0.5:0.1:20]
// Rounding of the corners of that lip in mm.
lip_rounding = 1.54; // [0.1:0.05:10]
// Undercut of the shoulder in mm: what snaps. 0 lets the joint slide apart.
barb = 0.528; // [0:0.05:4]
// Play between the shoulder and the bottom of the slit in mm.
seat_clearance = 0.05; // [0:0.05:2]
// How far the neck lies inside the long side, in mm.
neck_setback = 0.4; // [0:0.05:5]
// Rounding in the corner between neck and shoulder in mm. 0 is sharp.
relief = 0; // [0:0.05:2]
// Depth of the soft curve between two hooks in mm.
scoop_depth = 8; // [0:0.5:60]

/* [Printing] */

// Layer height in mm: the printed thickness is a whole number of layers.
layer_height = 0.1; // [0.04:0.01:0.4]

/* [Quality] */

// Pieces of a full circle. Does not change the size of the part.
segments = 96; // [32:8:256]

/* [Hidden] */

module need(met, name, value, remedy) {
    assert(met, str(name, " is ", value, ": ", remedy));
}

module need_number(name, value, low, high, unit) {
    need(is_num(value) && value >= low && value <= high, name, value,
         str("set a number from ", low, " to ", high, " ", unit));
}

// ---- element: limits ----
need_number("la", la, 20, 300, "mm");
need_number("lb", lb, 21, 450, "mm");
need_number("alpha", alpha, 50, 80, "degrees");
need_number("thickness", thickness, 0.1, 2, "mm");
need_number("slit", slit, 0.15, 4, "mm");
need_number("kerf", kerf, 0, 0.5, "mm");
need_number("finger_width", finger_width, 1.5, 20, "mm");
need_number("finger_length", finger_length, 0, 40, "mm");
need_number("finger_turn", finger_turn, -15, 30, "degrees");
need_number("hole_radius", hole_radius, 1.5, 30, "mm");
need_number("lip", lip, 0.5, 20, "mm");
need_number("lip_rounding", lip_rounding, 0.1, 10, "mm");
need_number("barb", barb, 0, 4, "mm");
need_number("seat_clearance", seat_clearance, 0, 2, "mm");
need_number("neck_setback", neck_setback, 0, 5, "mm");
need_number("relief", relief, 0, 2, "mm");
need_number("scoop_depth", scoop_depth, 0, 60, "mm");
need_number("segments", segments, 32, 256, "pieces");

need(lb > la, "lb", lb, str("the long side must be longer than la (", la, "): set lb to about ", 1.1 * la));
need(lb <= 1.5 * la, "lb", lb, str("the long side bows too far: set lb to at most 1.5 la (", 1.5 * la, ")"));
need(slit > thickness, "slit", slit, str("the sheet (", thickness, ") does not pass: set slit to thickness + 0.3"));
need(kerf < slit - 0.05, "kerf", kerf, str("the cut closes the slit (", slit, "): set kerf under ", slit - 0.05));
need(neck_depth() < hole_radius * sin(alpha / 2), "neck_setback", neck_setback,
     str("neck and relief reach across the node hole: make neck_setback or relief smaller"));
need(lip > lip_rounding, "lip_rounding", lip_rounding, str("set it under lip (", lip, ")"));
need(barb == 0 || seat_tangent() < min(neck_setback, lip - lip_rounding), "barb", barb,
     "too steep to be rounded: make barb smaller or neck_setback larger");
need(lb > 2 * (pivot_radius() + seat_clearance - barb + lip_rounding), "finger_width", finger_width,
     "no straight edge is left on the long side: make finger_width or hole_radius smaller");
need(la - 2 * (pivot_radius() + slit / 2 + finger_length * cos(finger_turn) + finger_width / 2) >= 0.3 * la,
     "finger_length", finger_length,
     "the two fingers of a short side come too near: make finger_length, finger_width or hole_radius smaller");
need(la - 2 * rim_end().x > 1, "finger_length", finger_length,
     "no room for the soft curve: make finger_length or finger_width smaller");
need(scoop_depth >= -rim_end().y, "scoop_depth", scoop_depth, str("set it to at least ", -rim_end().y));
// ---- end of limits ----

// ---- element: outline. The steps are those of exporters/outline.h, point by point. ----
// A vertex is [x, y, bulge]; bulge = tan(sweep / 4) of the arc that follows, 0 for a straight line.
scoop_biarcs = 12;

function last(v) = v[len(v) - 1];
function dot(a, b) = a.x * b.x + a.y * b.y;
function unit(v) = v / norm(v);
function at(p, bulge) = [p.x, p.y, bulge];

function pivot_radius() = hole_radius + finger_width;
function neck_depth() = neck_setback + relief;

// Half a side, then its mirror image u -> length - u in reverse order.
function with_mirror_image(half, length) =
    concat(half, [for (i = [len(half) - 1 : -1 : 0])
        [length - half[i].x, half[i].y, i > 0 ? half[i - 1].z : 0]]);

// The concave corner of the shoulder turns by seat_turn() and is rounded.
function seat_turn() = atan2(barb, lip - lip_rounding);
function seat_radius() = max(0.3, 0.2 + 0.06 / (seat_turn() * PI / 180));
function seat_tangent() = barb > 0 ? seat_radius() * tan(seat_turn() / 2) : 0;
function seat(shoulder) = barb <= 0 ? [] : [
    [shoulder, -seat_tangent(), -tan(seat_turn() / 4)],
    [shoulder - seat_tangent() * sin(seat_turn()), seat_tangent() * cos(seat_turn()), 0]];

function half_long_side(h, shoulder) = concat(
    [[sqrt(hole_radius * hole_radius - h * h), -h, 0]],
    relief > 0 ? [[shoulder - relief, -h, -tan(22.5)]] : [],
    [[shoulder, -neck_setback, 0]],
    seat(shoulder),
    [[shoulder - barb, lip - lip_rounding, tan(22.5)], [shoulder - barb + lip_rounding, lip, 0]]);
function long_side() = with_mirror_image(half_long_side(neck_depth(), pivot_radius() + seat_clearance), lb);

// The finger leaves the slit's bottom along finger_d(); finger_n() points across it, outwards.
function finger_pivot() = [pivot_radius() + slit / 2, 0];
function finger_d() = [cos(finger_turn), -sin(finger_turn)];
function finger_n() = [sin(finger_turn), cos(finger_turn)];
function rim_end() = finger_pivot() - slit / 2 * finger_n() + (finger_length + finger_width) * finger_d();
function hook(cb, tip, outer, inner) = [
    [hole_radius, 0, tan((90 + finger_turn) / 4)],
    at(cb + outer, 0),
    at(tip + outer, 1),
    at(tip + inner, 0),
    at(cb + inner, -1),
    at(cb - inner, 0)];

// The scoop: a cubic, cut as pairs of arcs that meet where their tangents are equally long.
function bezier(c, t) = (1 - t) * (1 - t) * (1 - t) * c[0] + 3 * (1 - t) * (1 - t) * t * c[1]
    + 3 * (1 - t) * t * t * c[2] + t * t * t * c[3];
function bezier_tangent(c, t) =
    unit((1 - t) * (1 - t) * (c[1] - c[0]) + 2 * (1 - t) * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
function bulge_from_tangent(s, c) = (s.x * c.y - s.y * c.x) / (norm(c) + dot(s, c));
function biarc(p, s, q, t) =
    let (v = q - p, x = dot(v, s + t),
         l = dot(v, v) / (x + sqrt(x * x + 2 * (1 - dot(s, t)) * dot(v, v))),
         middle = (p + l * s + q - l * t) / 2)
    [at(p, -bulge_from_tangent(s, middle - p)),
     at(middle, -bulge_from_tangent(unit(q - p - l * (s + t)), q - middle))];
function scoop(e, f) =
    let (run = 0.35 * (f.x - e.x), depth = (scoop_depth + e.y) / 0.75,
         c = [e, e + [run, -depth], f - [run, depth], f])
    [for (i = [0 : scoop_biarcs - 1], v = let (t = i / scoop_biarcs, u = (i + 1) / scoop_biarcs)
        biarc(bezier(c, t), bezier_tangent(c, t), bezier(c, u), bezier_tangent(c, u))) v];

function half_short_side() = hook(finger_pivot(), finger_pivot() + finger_length * finger_d(),
                                  (slit / 2 + finger_width) * finger_n(), slit / 2 * finger_n());
function short_side() =
    let (half = half_short_side(), both = with_mirror_image(half, la),
         e = rim_end(), f = [la - e.x, e.y], n = len(half))
    concat(half, scoop(e, f), [at(f, 0)], [for (i = [n : len(both) - 1]) both[i]]);

// A side's frame: u along it, o outwards (to the right). Its last vertex starts the arc round the next node.
function placed_side(side, origin, u, hole_bulge) = [for (i = [0 : len(side) - 1])
    at(origin + side[i].x * u + side[i].y * [u.y, -u.x], i < len(side) - 1 ? side[i].z : hole_bulge)];
function hole_bulge(corner) = -tan((corner - asin(neck_depth() / hole_radius)) / 4);
function without_repeats(path) = [for (i = [0 : len(path) - 1])
    let (d = path[(i + 1) % len(path)] - path[i])
    if (norm([d.x, d.y]) > 1e-9) path[i]];

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
function arc_pieces(sweep) = max(ceil(segments / 32), ceil(segments * abs(sweep) / 360 - 1e-9));
function turned(v, a) = [cos(a) * v.x - sin(a) * v.y, sin(a) * v.x + cos(a) * v.y];
function arc_points(a, chord, sweep) =
    let (n = arc_pieces(sweep))
    [for (k = [0 : n - 1]) a + turned(chord, -(1 - k / n) * sweep / 2) * (sin(k / n * sweep / 2) / sin(sweep / 2))];
function path_points(path) = [for (i = [0 : len(path) - 1],
    p = let (a = [path[i].x, path[i].y], b = path[(i + 1) % len(path)])
        path[i].z == 0 ? [a] : arc_points(a, [b.x, b.y] - a, 4 * atan(path[i].z))) p];
function element_points() = path_points(element_path());

function sum(v, i = 0, s = 0) = i < len(v) ? sum(v, i + 1, s + v[i]) : s;
function area(points) = sum([for (i = [0 : len(points) - 1])
    let (a = points[i], b = points[(i + 1) % len(points)]) (a.x * b.y - a.y * b.x) / 2]);
function cut_length(points) = sum([for (i = [0 : len(points) - 1]) norm(points[(i + 1) % len(points)] - points[i])]);
// ---- end of outline ----

need(part == "cut" || part == "print" || part == "pair", "part", part, "choose cut, print or pair");
need_number("layer_height", layer_height, 0.04, 0.4, "mm");

outline = element_points();
printed = max(1, round(thickness / layer_height)) * layer_height;
need(part != "print" || printed < slit - 0.05, "layer_height", layer_height,
     str("whole layers make the print ", printed, " mm thick, too much for the slit (", slit, "): set thinner layers"));

module cut() {
    offset(delta = kerf / 2) polygon(outline);
}

if (part == "cut") {
    cut();
} else if (part == "print") {
    linear_extrude(height = printed) polygon(outline);
} else {
    cut();
    translate([0, la * sin(alpha) + 2 * lip + 2 * finger_width + 5]) cut();
}

echo(str("element: area ", area(outline) / 100, " cm2, cut length ", cut_length(outline), " mm, slit ", slit, " mm",
         part == "print" ? str(", printed ", printed, " mm thick") : ""));
