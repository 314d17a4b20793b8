#pragma once

#include <future>
#include <mutex>
#include <set>

#include "apps/studio/server/reply.h"
#include "core/model/element.h"
#include "exporters/materials.h"

namespace rhombloom::studio {

//! \brief What the page shows beside the document: shapes and their pictures, the piece's outline, sheets and minutes.
class Library
{
public:
    //! GET /api/shapes: name, summary and number of elements of every base shape.
    Reply shapes(const Element& element);

    //! GET /api/thumbnail?shape=NAME: a picture of it, PNG.
    Reply thumbnail(const Request& request, const Element& element);

    //! GET /api/piece: the flat piece as triangles in the unit square of the rhomboid, u along the long side.
    Reply piece(const Element& element);

    //! GET /api/figures?count=N: about how many sheets and minutes N pieces take.
    Reply figures(const Request& request, const Element& element);

    //! GET /api/choices: materials, machines and papers to fabricate with.
    Reply choices() const;

private:
    //! What one piece takes on a full sheet, from a nesting of a few sheets.
    struct PerPiece
    {
        double sheets = 0;
        double minutes = 0;
        double mass_g = 0;
        std::string error;
    };

    PerPiece per_piece(const Element& element);

    std::mutex mutex_;
    std::map<std::string, std::string> thumbnails_; //!< by element and shape
    std::map<std::string, PerPiece> per_piece_;     //!< by element
    std::map<std::string, std::string> shapes_;     //!< by element
};

} // namespace rhombloom::studio
