#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "exporters/drawing.h"

namespace rhombloom {

//! Something drawn once and placed often: one object of the file. Drawn about its own origin, without texts.
struct PdfGroup
{
    double extent = 0; //!< points that it reaches from the origin
    std::string content;
};

//! A piece of the document's structure.
struct PdfTag
{
    std::string tag;         //!< "Sect", "H1", "P", "Figure" ...
    std::string alternative; //!< a text that stands for a figure
    int mark = -1;           //!< number of its content on the page; -1: it only holds others
    int link = -1;           //!< index of the link that it is; -1: none
    std::vector<PdfTag> kids;
};

struct PdfLink
{
    Box box; //!< points, y down
    std::string destination;
};

struct PdfBookmark
{
    int level = 0; //!< 0: a chapter, 1: in the chapter before
    std::string title;
    double top = 0; //!< where it leads: points from the page's top
};

//! A page as it was drawn, before it becomes part of a document.
struct PdfPage
{
    std::string label;
    int section = -1; //!< pages in a row with the same number are one section; -1: in none
    std::string content;
    std::vector<std::shared_ptr<const PdfGroup>> groups; //!< called G0, G1 ... in the content
    std::vector<PdfTag> tags;
    int marks = 0; //!< pieces of marked content
    std::vector<PdfLink> links;
    std::vector<PdfBookmark> bookmarks;
    std::map<std::string, double> destinations; //!< name -> points from the page's top
    std::set<char32_t> characters;              //!< used
    std::string problem;                        //!< why the page cannot be drawn; empty: it is right
};

//! \brief Coordinates in the content of pages and groups are sixteenths of a point.
inline constexpr double pdf_units = 16;

} // namespace rhombloom
