#include "core/design/symmetry.h"

#include <algorithm>
#include <set>

namespace rhombloom {

namespace {

constexpr double reach = 1.0 / 3; // of la: how far an image vertex may lie from where it is expected

SymmetryImage mirror(const Symmetry& symmetry)
{
    const Vec3 n = symmetry.direction.normalized();
    SymmetryImage image;
    image.mirrors = true;
    image.map.linear() = Eigen::Matrix3d::Identity() - 2 * n * n.transpose();
    image.map.translation() = symmetry.through - image.map.linear() * symmetry.through;
    return image;
}

SymmetryImage turn(const Symmetry& symmetry, int k)
{
    SymmetryImage image;
    image.map.linear() =
        Eigen::AngleAxisd(two_pi * k / symmetry.fold, symmetry.direction.normalized()).toRotationMatrix();
    image.map.translation() = symmetry.through - image.map.linear() * symmetry.through;
    return image;
}

//! Old vertices go to their image, new ones keep their number.
Expected<Quad> image_quad(const Surface& surface, const Element& element, const SymmetryImage& image, const Quad& q)
{
    Quad result{};
    for (int k = 0; k < 4; ++k) {
        const int v = q[image.mirrors ? (4 - k) % 4 : k];
        if (v >= static_cast<int>(surface.n_vertices())) {
            result[k] = v;
            continue;
        }
        const auto w = image_vertex(surface, element, image, Vertex(v));
        if (!w) {
            return tl::make_unexpected(w.error());
        }
        result[k] = w->idx();
    }
    return result;
}

//! Turn \p q so that it starts where \p face starts, but for the corners that are new.
Quad like_face(Quad q, const Quad& face)
{
    const auto agree = [&] {
        int same = 0;
        for (int k = 0; k < 4; ++k) {
            same += q[k] == face[k] ? 1 : 0;
        }
        return same;
    };
    for (int turns = 0; turns < 3 && agree() < 3; ++turns) {
        std::rotate(q.begin(), q.begin() + 1, q.end());
    }
    return q;
}

std::set<int> touched_faces(const Graft& change)
{
    std::set<int> faces(change.removed.begin(), change.removed.end());
    for (const auto& [f, q] : change.rewritten) {
        faces.insert(f);
    }
    return faces;
}

bool overlap(const std::set<int>& a, const std::set<int>& b)
{
    return std::any_of(a.begin(), a.end(), [&](int f) { return b.contains(f); });
}

Expected<void> image_elements(const Surface& surface, const Element& element, const SymmetryImage& image,
                              const Graft& change, Graft& result)
{
    for (int& f : result.removed) {
        const auto g = image_face(surface, element, image, Face(f));
        if (!g) {
            return tl::make_unexpected(g.error());
        }
        f = g->idx();
    }
    for (auto& [f, q] : result.rewritten) {
        const auto g = image_face(surface, element, image, Face(f));
        const auto r = image_quad(surface, element, image, q);
        if (!g || !r) {
            return tl::make_unexpected(g ? r.error() : g.error());
        }
        q = like_face(*r, quad(surface, *g));
        f = g->idx();
    }
    for (std::size_t i = 0; i < change.quads.size(); ++i) {
        const auto r = image_quad(surface, element, image, change.quads[i]);
        if (!r) {
            return tl::make_unexpected(r.error());
        }
        result.quads[i] = *r;
    }
    return {};
}

Expected<int> image_number(const Surface& surface, const Element& element, const SymmetryImage& image, int v)
{
    if (v < 0 || v >= static_cast<int>(surface.n_vertices())) {
        return v;
    }
    return image_vertex(surface, element, image, Vertex(v)).map([](Vertex w) { return w.idx(); });
}

} // namespace

std::vector<SymmetryImage> images(const Symmetry& symmetry)
{
    std::vector<SymmetryImage> result;
    if (symmetry.kind == Symmetry::Kind::Mirror) {
        result.push_back(mirror(symmetry));
    }
    for (int k = 1; symmetry.kind == Symmetry::Kind::Axis && k < symmetry.fold; ++k) {
        result.push_back(turn(symmetry, k));
    }
    return result;
}

Expected<Vertex> image_vertex(const Surface& surface, const Element& element, const SymmetryImage& image, Vertex v)
{
    const Vec3 target = image.map * surface.point(v);
    Vertex nearest;
    double best = reach * element.la;
    for (const Vertex w : surface.vertices()) {
        const double distance = (surface.point(w) - target).norm();
        if (distance < best) {
            best = distance;
            nearest = w;
        }
    }
    if (!nearest.is_valid()) {
        return refuse("the surface is not symmetric here: vertex " + std::to_string(v.idx()) +
                      " has no image; leave out \"symmetric\" or build the place symmetrically first");
    }
    return nearest;
}

Expected<Face> image_face(const Surface& surface, const Element& element, const SymmetryImage& image, Face f)
{
    const auto target = image_quad(surface, element, image, quad(surface, f));
    if (!target) {
        return tl::make_unexpected(target.error());
    }
    for (const Face g : surface.vf_range(Vertex((*target)[0]))) {
        const Quad q = quad(surface, g);
        if (std::is_permutation(q.begin(), q.end(), target->begin())) {
            return g;
        }
    }
    return refuse("the surface is not symmetric here: element " + std::to_string(f.idx()) +
                  " has no image; leave out \"symmetric\" or build the place symmetrically first");
}

Expected<Graft> image_graft(const Surface& surface, const Element& element, const SymmetryImage& image,
                            const Graft& change)
{
    Graft result = change;
    if (auto ok = image_elements(surface, element, image, change, result); !ok) {
        return tl::make_unexpected(ok.error());
    }
    for (auto& [a, b] : result.zipped) {
        const auto c = image_number(surface, element, image, a);
        const auto d = image_number(surface, element, image, b);
        if (!c || !d) {
            return tl::make_unexpected(c ? d.error() : c.error());
        }
        a = *c;
        b = *d;
    }
    for (auto& [v, p] : result.moved) {
        const auto w = image_number(surface, element, image, v);
        if (!w) {
            return tl::make_unexpected(w.error());
        }
        v = *w;
        p = image.map * p;
    }
    for (int& tip : result.tips) {
        const auto w = image_number(surface, element, image, tip);
        if (!w) {
            return tl::make_unexpected(w.error());
        }
        tip = *w;
    }
    for (Vec3& p : result.positions) {
        p = image.map * p;
    }
    std::fill(result.serials.begin(), result.serials.end(), -1);
    return result;
}

Expected<std::vector<Graft>> symmetric_grafts(const Surface& surface, const Element& element, const Symmetry& symmetry,
                                              const Graft& change)
{
    std::vector<Graft> result = {change};
    std::vector<std::set<int>> touched = {touched_faces(change)};
    for (const SymmetryImage& image : images(symmetry)) {
        auto copy = image_graft(surface, element, image, change);
        if (!copy) {
            return tl::make_unexpected(copy.error());
        }
        const std::set<int> faces = touched_faces(*copy);
        if (faces == touched.front()) {
            continue;
        }
        if (std::any_of(touched.begin(), touched.end(), [&](const auto& other) { return overlap(other, faces); })) {
            return refuse("the images of the symmetric operation overlap; move it away from the plane or axis");
        }
        const std::string number = " " + std::to_string(result.size() + 1);
        for (std::string& name : copy->component_names) {
            name += number;
        }
        touched.push_back(faces);
        result.push_back(std::move(*copy));
    }
    return result;
}

} // namespace rhombloom
