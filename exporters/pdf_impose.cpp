#include "exporters/pdf_objects.h"

#define POINTERHOLDER_TRANSITION 4 // qpdf 11: std::shared_ptr only
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "core/text.h"

namespace rhombloom {

namespace {

QPDFObjectHandle name(const std::string& text)
{
    return QPDFObjectHandle::newName(text);
}

//! Scales a page into the left (0) or right (1) half of a sheet of turned paper.
std::string placed_half(const std::string& form, const PaperSize& sheet, int half)
{
    const double width = sheet.height / 2; // of the half; the sheet lies on its side
    const double scale = std::min(width / sheet.width, sheet.width / sheet.height);
    const double x = half * width + (width - scale * sheet.width) / 2;
    const double y = (sheet.width - scale * sheet.height) / 2;
    return "q " + to_fixed(scale, 6) + " 0 0 " + to_fixed(scale, 6) + " " + to_fixed(x, 3) + " " + to_fixed(y, 3) +
           " cm " + form + " Do Q\n";
}

QPDFObjectHandle sheet_side(QPDF& target, const PaperSize& paper)
{
    QPDFObjectHandle page = QPDFObjectHandle::newDictionary();
    page.replaceKey("/Type", name("/Page"));
    QPDFObjectHandle box = QPDFObjectHandle::newArray();
    for (const double value : {0.0, 0.0, paper.height, paper.width}) {
        box.appendItem(QPDFObjectHandle::newReal(to_fixed(value, 4)));
    }
    page.replaceKey("/MediaBox", box);
    QPDFObjectHandle resources = QPDFObjectHandle::newDictionary();
    resources.replaceKey("/XObject", QPDFObjectHandle::newDictionary());
    page.replaceKey("/Resources", resources);
    return target.makeIndirectObject(page);
}

//! A page as a form, its content taken over as it is packed.
QPDFObjectHandle page_form(QPDF& target, QPDFObjectHandle page, const PaperSize& size)
{
    QPDFObjectHandle content = page.getKey("/Contents");
    const auto data = content.getRawStreamData();
    QPDFObjectHandle form = QPDFObjectHandle::newStream(&target);
    form.replaceDict(QPDFObjectHandle::parse("<</Type/XObject/Subtype/Form/BBox[0 0 " + to_fixed(size.width, 4) + " " +
                                             to_fixed(size.height, 4) + "]>>"));
    form.getDict().replaceKey("/Resources", QPDFObjectHandle::newDictionary());
    QPDFObjectHandle resources = page.getKey("/Resources");
    for (const std::string& kind : resources.getKeys()) {
        QPDFObjectHandle copies = QPDFObjectHandle::newDictionary();
        for (const std::string& key : resources.getKey(kind).getKeys()) {
            copies.replaceKey(key, target.copyForeignObject(resources.getKey(kind).getKey(key)));
        }
        form.getDict().getKey("/Resources").replaceKey(kind, copies);
    }
    form.replaceStreamData(data, content.getDict().getKey("/Filter"), QPDFObjectHandle::newNull());
    return form;
}

} // namespace

std::string impose_pdf(const std::string& bytes, Paper paper, const std::string& title)
{
    const PaperSize size = paper_size(paper);
    QPDF source;
    source.processMemoryFile("booklet", bytes.data(), bytes.size());
    QPDF target;
    target.emptyPDF();
    std::vector<QPDFPageObjectHelper> pages = QPDFPageDocumentHelper(source).getAllPages();
    const int count = static_cast<int>(pages.size());
    const int last = (count + 3) / 4 * 4 - 1;
    for (int s = 0; s <= last / 2; ++s) { // one side of a sheet: fronts have the outer page on the left
        const int low = s;
        const int high = last - s;
        const int on_half[] = {s % 2 == 0 ? high : low, s % 2 == 0 ? low : high};
        QPDFObjectHandle side = sheet_side(target, size);
        std::string content;
        for (int half = 0; half < 2; ++half) {
            if (on_half[half] < count) {
                const std::string key = half == 0 ? "/L" : "/R";
                side.getKey("/Resources")
                    .getKey("/XObject")
                    .replaceKey(key, page_form(target, pages[on_half[half]].getObjectHandle(), size));
                content += placed_half(key, size, half);
            }
        }
        side.replaceKey("/Contents", QPDFObjectHandle::newStream(&target, content));
        QPDFPageDocumentHelper(target).addPage(QPDFPageObjectHelper(side), false);
    }
    describe_document(target, {title, "en"});
    return written(target);
}

} // namespace rhombloom
