#pragma once

namespace rhombloom {

//! Sizes of paper to print on.
enum class Paper
{
    A4,
    Letter
};

//! Width and height in points (1/72 inch).
struct PaperSize
{
    double width = 0;
    double height = 0;
};

inline PaperSize paper_size(Paper paper)
{
    return paper == Paper::A4 ? PaperSize{210 / 25.4 * 72, 297 / 25.4 * 72} : PaperSize{612, 792};
}

} // namespace rhombloom
