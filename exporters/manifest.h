#pragma once

#include "exporters/bulb_clearance.h"
#include "exporters/kit.h"

namespace rhombloom {

//! \brief What kit.json and README.txt tell: collected by make_kit.
struct Summary
{
    std::string title;
    const Piece& piece;
    const Buildability& build;
    const CutReport& cut;
    const Scorecard& scorecard;
    const std::vector<std::string>& warnings;
    const KitOptions& options;
    const Design& design;
    const std::vector<BulbFit>& bulbs;
};

//! \brief kit.json (DESIGN.md section 7) for these files.
std::string manifest_json(const Summary& summary, const FileSet& files);

//! \brief README.txt: one page, what is in the folder and what to do first.
std::string readme_text(const Summary& summary, const FileSet& files);

//! \brief The files that an older kit.json lists; empty when it is no manifest
//! of ours.
std::vector<std::string> listed_files(const std::string& manifest);

} // namespace rhombloom
