#include "exporters/pdf_font.h"

#include <cmath>

#include <hb-ot.h>
#include <hb-subset.h>

namespace rhombloom {

struct PdfFont::State
{
    hb_face_t* face = nullptr;
    hb_font_t* font = nullptr;
    double em = 1000; // font units

    ~State()
    {
        hb_font_destroy(font);
        hb_face_destroy(face);
    }

    int measure(hb_ot_metrics_tag_t tag, int otherwise) const
    {
        hb_position_t value = 0;
        const bool found = hb_ot_metrics_get_position(font, tag, &value) != 0;
        return found ? static_cast<int>(std::lround(1000 * value / em)) : otherwise;
    }
};

PdfFont::PdfFont(std::unique_ptr<State> state) : state_(std::move(state)) {}

PdfFont::~PdfFont() = default;

Expected<std::shared_ptr<const PdfFont>> PdfFont::load(const std::string& file)
{
    auto state = std::make_unique<State>();
    hb_blob_t* blob = hb_blob_create_from_file_or_fail(file.c_str());
    if (blob == nullptr) {
        return machine_failure("cannot read the booklet's font " + file);
    }
    state->face = hb_face_create(blob, 0);
    hb_blob_destroy(blob);
    if (hb_face_get_glyph_count(state->face) == 0) {
        return machine_failure("the booklet's font " + file + " is no TrueType font");
    }
    state->em = hb_face_get_upem(state->face);
    state->font = hb_font_create(state->face);
    hb_face_make_immutable(state->face);
    hb_font_make_immutable(state->font);
    return std::shared_ptr<const PdfFont>(new PdfFont(std::move(state)));
}

PdfFont::Glyph PdfFont::glyph(char32_t character) const
{
    hb_codepoint_t id = 0;
    if (hb_font_get_nominal_glyph(state_->font, character, &id) == 0) {
        return {};
    }
    return {id, hb_font_get_glyph_h_advance(state_->font, id) / state_->em};
}

bool PdfFont::writes(char32_t character) const
{
    const hb_script_t script = hb_unicode_script(hb_unicode_funcs_get_default(), character);
    return glyph(character).id != 0 && hb_script_get_horizontal_direction(script) != HB_DIRECTION_RTL;
}

PdfFont::Measures PdfFont::measures() const
{
    Measures m;
    m.ascent = state_->measure(HB_OT_METRICS_TAG_HORIZONTAL_ASCENDER, 800);
    m.descent = state_->measure(HB_OT_METRICS_TAG_HORIZONTAL_DESCENDER, -200);
    m.cap_height = state_->measure(HB_OT_METRICS_TAG_CAP_HEIGHT, 700);
    m.low_x = -1000; // the tallest and widest glyphs of any script; viewers only take it as a hint
    m.low_y = m.descent;
    m.high_x = 2000;
    m.high_y = m.ascent;
    return m;
}

std::string PdfFont::subset(const std::set<char32_t>& characters) const
{
    hb_subset_input_t* input = hb_subset_input_create_or_fail();
    expects(input != nullptr, "PdfFont::subset: memory");
    for (const char32_t c : characters) {
        hb_set_add(hb_subset_input_unicode_set(input), c);
    }
    // What a font inside a PDF has no use for: its glyphs are called by number.
    for (const char* table : {"cmap", "OS/2", "name", "post", "GSUB", "GPOS", "GDEF", "kern", "gasp", "FFTM"}) {
        hb_set_add(hb_subset_input_set(input, HB_SUBSET_SETS_DROP_TABLE_TAG), hb_tag_from_string(table, -1));
    }
    hb_subset_input_set_flags(input, HB_SUBSET_FLAGS_NO_HINTING | HB_SUBSET_FLAGS_RETAIN_GIDS);
    hb_face_t* small = hb_subset_or_fail(state_->face, input);
    hb_subset_input_destroy(input);
    expects(small != nullptr, "PdfFont::subset: a font that can be read can be cut down");
    hb_blob_t* blob = hb_face_reference_blob(small);
    unsigned length = 0;
    const char* data = hb_blob_get_data(blob, &length);
    std::string bytes(data, length);
    hb_blob_destroy(blob);
    hb_face_destroy(small);
    return bytes;
}

} // namespace rhombloom
