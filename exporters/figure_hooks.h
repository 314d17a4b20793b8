#pragma once

#include "exporters/figure.h"

namespace rhombloom {

//! \brief The flat piece in coordinates of its nodes: (0, 0) is v0, (1, 0) v1, (1, 1) v2, (0, 1) v3, so that it can be
//! laid over any bent element.
struct PieceContour
{
    std::vector<Vec2> outline;                           //!< closed
    std::array<std::vector<std::vector<Vec2>>, 4> flaps; //!< what lies beyond each side: two hooks, or one lip
};

//! \brief The contour for an element, good to 0.3 mm; a plain rhomboid when no hook can be made for it.
PieceContour piece_contour(const Element& element);

//! \brief The piece on the paper, in the place of an element, turned over when it is flipped.
Polygon piece_on_paper(const FigureScene& scene, Face f, const PieceContour& contour);

struct DrawnPiece
{
    Face face;
    Paint paint = Paint::Built;
    bool hooks = true; //!< false: only the rhomboid, e.g. for what is seen from inside or mostly hidden
};

//! \brief One piece without regard to others.
void draw_piece(PdfCanvas& canvas, const FigureScene& scene, const DrawnPiece& piece, const PieceContour& contour);

//! \brief Once more what lies beyond one side of the piece (0 and 2 are long, with lips; 1 and 3 short, with hooks).
//! \param count of the side's flaps, from its first corner on
void draw_flaps(PdfCanvas& canvas, const FigureScene& scene, const DrawnPiece& piece, const PieceContour& contour,
                int side, int count = 2);

//! \brief Pieces with their hooks and lips, back to front. At joints the hooks of short sides lie over the long side,
//! whose lip lies over the short side's rim: no order of whole pieces can show that, so what reaches beyond a piece's
//! own sides is drawn after all bodies.
void draw_pieces(PdfCanvas& canvas, const FigureScene& scene, const std::vector<DrawnPiece>& pieces,
                 const PieceContour& contour);

//! \brief The faces that share a vertex with \p f.
std::vector<Face> faces_round(const Surface& surface, Face f);

} // namespace rhombloom
