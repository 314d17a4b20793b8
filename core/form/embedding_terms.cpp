#include "core/form/embedding_terms.h"

namespace rhombloom {

namespace {

void add_spring(SpringPair& pair, double rest)
{
    pair.rest[pair.count] = rest;
    pair.inverse_rest[pair.count] = 1 / rest;
    if (pair.count++ == 0) {
        pair.rest[1] = rest;
    }
}

SpringPair single_spring(int a, int b, double rest)
{
    SpringPair pair{a, b, 0, {0, 0}, {0, 0}};
    add_spring(pair, rest);
    return pair;
}

void add_edge(EmbeddingTerms& terms, const Surface& surface, const Element& element, Edge e)
{
    SpringPair pair;
    for (int side_of_edge = 0; side_of_edge < 2; ++side_of_edge) {
        const Halfedge h = surface.halfedge_handle(e, side_of_edge);
        if (!surface.is_boundary(h)) {
            pair.a = surface.from_vertex_handle(h).idx();
            pair.b = surface.to_vertex_handle(h).idx();
            add_spring(pair, side_length(element, side(surface, h)) / element.la);
        }
    }
    terms.springs.push_back(pair);
}

void add_diagonals(EmbeddingTerms& terms, const Surface& surface, const Element& element, Face f)
{
    const Quad q = quad(surface, f);
    const double at_first = corner_angle(surface, element, f, Vertex(q[0]));
    // The short diagonal joins the obtuse corners.
    const bool first_is_acute = at_first < pi / 2;
    const double from_first = first_is_acute ? long_diagonal(element) : short_diagonal(element);
    const double other = first_is_acute ? short_diagonal(element) : long_diagonal(element);
    terms.springs.push_back(single_spring(q[0], q[2], from_first / element.la));
    terms.springs.push_back(single_spring(q[1], q[3], other / element.la));
}

void add_hinges(EmbeddingTerms& terms, const Surface& surface, Edge e)
{
    if (surface.is_boundary(e)) {
        return;
    }
    const Halfedge left = surface.halfedge_handle(e, 0);
    const Halfedge right = surface.halfedge_handle(e, 1);
    const int a = surface.from_vertex_handle(left).idx();
    const int b = surface.to_vertex_handle(left).idx();
    const int c = surface.to_vertex_handle(surface.next_halfedge_handle(left)).idx();
    const int d = surface.from_vertex_handle(surface.prev_halfedge_handle(left)).idx();
    const int at_a = surface.to_vertex_handle(surface.next_halfedge_handle(right)).idx();
    const int at_b = surface.from_vertex_handle(surface.prev_halfedge_handle(right)).idx();
    if (d != at_a) {
        terms.hinges.push_back({a, b, d, at_a});
    }
    if (c != at_b) {
        terms.hinges.push_back({a, b, c, at_b});
    }
}

} // namespace

EmbeddingTerms embedding_terms(const Surface& surface, const Element& element, const EmbedOptions& options)
{
    EmbeddingTerms terms;
    terms.vertex_count = static_cast<int>(surface.n_vertices());
    terms.free_count = terms.vertex_count;
    terms.la = element.la;
    terms.spring_law.barrier_ratio = barrier_ratio(element.la, element.lb);
    terms.hinge_law.concavity_weight = options.concavity_weight;
    terms.hinge_law.convex_weight = options.convex_weight;
    for (const Edge e : surface.edges()) {
        add_edge(terms, surface, element, e);
    }
    terms.edge_count = static_cast<int>(terms.springs.size());
    for (const Face f : surface.faces()) {
        add_diagonals(terms, surface, element, f);
    }
    for (const Edge e : surface.edges()) {
        add_hinges(terms, surface, e);
    }
    return terms;
}

} // namespace rhombloom
