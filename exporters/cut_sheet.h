#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/element.h"
#include "exporters/cut_time.h"
#include "exporters/drawing.h"
#include "exporters/dxf.h"
#include "exporters/machines.h"
#include "exporters/nesting.h"
#include "exporters/outline.h"
#include "exporters/paper.h"
#include "exporters/save.h"

namespace rhombloom {

//! Numbers and the arrow that marks the front.
enum class Engraving
{
    Off,
    On
};

//! \brief How the pieces are to be cut. Lengths in mm.
struct CutOptions
{
    std::string machine = {}; //!< a name for the notes; see use_machine()
    double sheet_width = 600; //!< 600 x 400 is what the common 60 W lasers take
    double sheet_height = 400;
    double margin = 3;  //!< between a finished edge and the sheet's
    double spacing = 2; //!< between finished edges of neighbours
    double kerf_x = 0;  //!< FULL width of the cut; 0: the cutting program compensates
    double kerf_y = 0;
    double spares = 0; //!< share of the count, rounded up
    Engraving engraving = Engraving::On;
    ColourPreset colours = ColourPreset::LightBurn;
    bool annotations = true;                 //!< sheet border and reference square
    std::optional<double> stroke_width = {}; //!< of SVG lines; by default as the colours' machines want it
    DxfVersion dxf = DxfVersion::R2000;
    std::optional<SheetSize> remnant = {}; //!< an offcut that is filled first
    Grain grain = Grain::Any;
    Speeds speeds = {};
    double density = 0.905;     //!< g/cm3, polypropylene
    double price_per_sheet = 0; //!< cost is reported when a price is given
    double price_per_minute = 0;
    Paper paper = Paper::A4;             //!< of the 1:1 template
    std::vector<std::string> notes = {}; //!< more settings to record in the files, one "key: value" each
};

//! \brief Take sheet, margin, colours, DXF version, annotations and speeds from a machine.
void use_machine(CutOptions& options, const Machine& machine);

struct CutReport
{
    int elements = 0; //!< without spares
    int spares = 0;
    int sheets = 0;
    double utilisation = 0;  //!< area of the pieces / area of the sheets used, the last one to its filled height
    double cut_length_m = 0; //!< without the coupon
    double engrave_length_m = 0;
    double travel_m = 0;
    int pierces = 0;
    double minutes = 0;
    Speeds speeds = {}; //!< that the minutes assume
    double mass_g = 0;  //!< of all pieces
    std::optional<double> cost = {};
    SheetSize remnant = {};       //!< left of the last sheet; 0 x 0 when nothing is
    std::string coupon_text = {}; //!< for the README: how to read the coupon and which option to set
    std::string layers_text = {}; //!< for the README: name, colour and use of each layer, in cutting order
    std::string speeds_text = {}; //!< for the README: what the minutes assume
    std::vector<std::string> warnings = {};
};

//! What cut_files() writes, before it becomes text.
struct CutDrawings
{
    std::vector<Drawing> sheets;
    std::optional<Drawing> coupon; //!< none when the sheet is too small for it; a warning says so
    CutReport report;
};

struct CutFiles
{
    FileSet files; //!< cut/sheet-01.svg, cut/sheet-01.dxf, ..., cut/coupon.svg/.dxf, cut/template-1to1.pdf
    CutReport report;
};

//! \brief The sheets for \p count pieces and what it takes to cut them. Refuses options that no machine has, and
//! pieces that the sheet or the kerf does not allow.
Expected<CutDrawings> cut_drawings(const Element& element, const HookParameters& parameters, int count,
                                   const CutOptions& options);

//! \brief All files for cutting \p count pieces, and what it takes to cut them.
Expected<CutFiles> cut_files(const Element& element, const HookParameters& parameters, int count,
                             const CutOptions& options);

} // namespace rhombloom
