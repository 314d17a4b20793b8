#include "exporters/pdf_finish.h"

#include <charconv>
#include <cstdlib>
#include <ctime>

#define POINTERHOLDER_TRANSITION 4 // qpdf 11: std::shared_ptr only
#include <qpdf/Pl_Flate.hh>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>
#include <qpdf/QPDFWriter.hh>

#include "core/text.h"
#include "exporters/markup.h"

namespace rhombloom {

namespace {

//! SOURCE_DATE_EPOCH, or 1 January 2000: never now, so that the same design gives the same bytes.
std::tm document_time()
{
    std::time_t seconds = 946684800;
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
        long long value = 0;
        const std::string text = epoch;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && end == text.data() + text.size() && value >= 0 && value < 253402300800LL) {
            seconds = static_cast<std::time_t>(value);
        }
    }
    std::tm time{};
    gmtime_r(&seconds, &time);
    return time;
}

std::string digits(int value, int count)
{
    std::string text = std::to_string(value);
    return std::string(static_cast<std::size_t>(std::max(0, count - static_cast<int>(text.size()))), '0') + text;
}

std::string pdf_date()
{
    const std::tm t = document_time();
    return "D:" + digits(t.tm_year + 1900, 4) + digits(t.tm_mon + 1, 2) + digits(t.tm_mday, 2) + digits(t.tm_hour, 2) +
           digits(t.tm_min, 2) + digits(t.tm_sec, 2) + "+00'00'";
}

std::string xmp_date()
{
    const std::tm t = document_time();
    return digits(t.tm_year + 1900, 4) + "-" + digits(t.tm_mon + 1, 2) + "-" + digits(t.tm_mday, 2) + "T" +
           digits(t.tm_hour, 2) + ":" + digits(t.tm_min, 2) + ":" + digits(t.tm_sec, 2) + "+00:00";
}

constexpr const char* program = "rhombloom";

std::string xmp(const DocumentInfo& info)
{
    const std::string date = xmp_date();
    return "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
           "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
           "<rdf:Description rdf:about=\"\" xmlns:pdfaid=\"http://www.aiim.org/pdfa/ns/id/\"><pdfaid:part>1"
           "</pdfaid:part><pdfaid:conformance>B</pdfaid:conformance></rdf:Description>\n"
           "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\"><dc:format>application/pdf"
           "</dc:format><dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">" +
           markup_escaped(info.title) +
           "</rdf:li></rdf:Alt></dc:title></rdf:Description>\n"
           "<rdf:Description rdf:about=\"\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"><xmp:CreatorTool>" +
           program + "</xmp:CreatorTool><xmp:CreateDate>" + date + "</xmp:CreateDate><xmp:ModifyDate>" + date +
           "</xmp:ModifyDate></rdf:Description>\n"
           "<rdf:Description rdf:about=\"\" xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\"><pdf:Producer>" +
           program +
           "</pdf:Producer></rdf:Description>\n"
           "</rdf:RDF></x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

QPDFObjectHandle text_string(const std::string& utf8)
{
    return QPDFObjectHandle::newUnicodeString(utf8);
}

QPDFObjectHandle name(const std::string& text)
{
    return QPDFObjectHandle::newName(text);
}

void set_info(QPDF& pdf, const DocumentInfo& info)
{
    QPDFObjectHandle dictionary = QPDFObjectHandle::newDictionary();
    dictionary.replaceKey("/Title", text_string(info.title));
    dictionary.replaceKey("/Creator", text_string(program));
    dictionary.replaceKey("/Producer", text_string(program));
    dictionary.replaceKey("/CreationDate", QPDFObjectHandle::newString(pdf_date()));
    dictionary.replaceKey("/ModDate", QPDFObjectHandle::newString(pdf_date()));
    pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(dictionary));
}

void set_metadata(QPDF& pdf, const DocumentInfo& info)
{
    QPDFObjectHandle root = pdf.getRoot();
    QPDFObjectHandle metadata = QPDFObjectHandle::newStream(&pdf, xmp(info));
    metadata.getDict().replaceKey("/Type", name("/Metadata"));
    metadata.getDict().replaceKey("/Subtype", name("/XML"));
    root.replaceKey("/Metadata", metadata);

    QPDFObjectHandle profile = QPDFObjectHandle::newStream(&pdf, srgb_profile());
    profile.getDict().replaceKey("/N", QPDFObjectHandle::newInteger(3));
    QPDFObjectHandle intent = QPDFObjectHandle::newDictionary();
    intent.replaceKey("/Type", name("/OutputIntent"));
    intent.replaceKey("/S", name("/GTS_PDFA1"));
    intent.replaceKey("/OutputConditionIdentifier", QPDFObjectHandle::newString("sRGB IEC61966-2.1"));
    intent.replaceKey("/Info", QPDFObjectHandle::newString("sRGB IEC61966-2.1"));
    intent.replaceKey("/DestOutputProfile", profile);
    QPDFObjectHandle intents = QPDFObjectHandle::newArray();
    intents.appendItem(pdf.makeIndirectObject(intent));
    root.replaceKey("/OutputIntents", intents);
}

void set_catalogue(QPDF& pdf, const DocumentInfo& info)
{
    QPDFObjectHandle root = pdf.getRoot();
    root.replaceKey("/Lang", QPDFObjectHandle::newString(info.language));
    if (root.hasKey("/Outlines")) {
        root.replaceKey("/PageMode", name("/UseOutlines"));
    }
    QPDFObjectHandle preferences = QPDFObjectHandle::newDictionary();
    preferences.replaceKey("/DisplayDocTitle", QPDFObjectHandle::newBool(true));
    root.replaceKey("/ViewerPreferences", preferences);
}

//! Opaque drawing needs no transparency groups; PDF/A-1 allows none. Links must be printable.
void clean_objects(QPDF& pdf)
{
    for (QPDFObjectHandle object : pdf.getAllObjects()) {
        QPDFObjectHandle dictionary = object.isStream() ? object.getDict() : object;
        if (!dictionary.isDictionary()) {
            continue;
        }
        if (dictionary.hasKey("/Group")) {
            dictionary.removeKey("/Group");
        }
        const bool annotation = dictionary.hasKey("/Subtype") && dictionary.getKey("/Subtype").isName() &&
                                dictionary.getKey("/Subtype").getName() == "/Link";
        if (annotation) {
            dictionary.replaceKey("/F", QPDFObjectHandle::newInteger(4));
        }
    }
}

//! What cairo leaves out of fonts with more than the Latin letters and PDF/A-1 asks for: glyph numbers are character
//! numbers, and which of them the subset has (all, counted by their widths).
void complete_cid_fonts(QPDF& pdf)
{
    for (QPDFObjectHandle font : pdf.getAllObjects()) {
        if (!font.isDictionary() || !font.getKey("/Subtype").isName() ||
            font.getKey("/Subtype").getName() != "/CIDFontType2") {
            continue;
        }
        font.replaceKey("/CIDToGIDMap", name("/Identity"));
        QPDFObjectHandle widths = font.getKey("/W").getArrayItem(1);
        std::string bits(static_cast<std::size_t>(widths.getArrayNItems() + 7) / 8, '\0');
        for (int cid = 0; cid < widths.getArrayNItems(); ++cid) {
            bits[cid / 8] = static_cast<char>(bits[cid / 8] | (0x80 >> cid % 8));
        }
        font.getKey("/FontDescriptor").replaceKey("/CIDSet", QPDFObjectHandle::newStream(&pdf, bits));
    }
}

//! Walks the structure tree in its order.
void set_alternatives(QPDFObjectHandle node, const std::vector<std::string>& texts, std::size_t& next)
{
    if (node.isArray()) {
        for (QPDFObjectHandle child : node.getArrayAsVector()) {
            set_alternatives(child, texts, next);
        }
    }
    if (!node.isDictionary()) {
        return;
    }
    QPDFObjectHandle kind = node.getKey("/S");
    if (kind.isName() && kind.getName() == "/Figure" && next < texts.size()) {
        node.replaceKey("/Alt", text_string(texts[next++]));
    }
    set_alternatives(node.getKey("/K"), texts, next);
}

//! \param repack compress again, as well as can be; not worth it for what was copied from a packed file.
std::string written(QPDF& pdf, bool repack)
{
    Pl_Flate::setCompressionLevel(9);
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.setObjectStreamMode(qpdf_o_disable); // PDF/A-1 is PDF 1.4
    writer.setDecodeLevel(qpdf_dl_generalized);
    writer.setRecompressFlate(repack);
    writer.setCompressStreams(true);
    writer.forcePDFVersion("1.4");
    writer.setDeterministicID(true);
    writer.setNewlineBeforeEndstream(true); // PDF/A-1 wants the end of line
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

} // namespace

std::string finish_pdf(const std::string& bytes, const DocumentInfo& info)
{
    QPDF pdf;
    pdf.setSuppressWarnings(true); // cairo 1.16 names a group twice in the resources of a page that shows it twice
    pdf.processMemoryFile("booklet", bytes.data(), bytes.size());
    clean_objects(pdf);
    complete_cid_fonts(pdf);
    set_info(pdf, info);
    set_metadata(pdf, info);
    set_catalogue(pdf, info);
    std::size_t next = 0;
    set_alternatives(pdf.getRoot().getKey("/StructTreeRoot"), info.alternatives, next);
    for (QPDFPageObjectHelper page : QPDFPageDocumentHelper(pdf).getAllPages()) {
        page.getObjectHandle().replaceKey("/Tabs", name("/S"));
    }
    return written(pdf, true);
}

namespace {

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
                const QPDFObjectHandle form = pages[on_half[half]].getFormXObjectForPage();
                const std::string key = half == 0 ? "/L" : "/R";
                side.getKey("/Resources").getKey("/XObject").replaceKey(key, target.copyForeignObject(form));
                content += placed_half(key, size, half);
            }
        }
        side.replaceKey("/Contents", QPDFObjectHandle::newStream(&target, content));
        QPDFPageDocumentHelper(target).addPage(QPDFPageObjectHelper(side), false);
    }
    const DocumentInfo info{title, "en", {}};
    set_info(target, info);
    set_metadata(target, info);
    set_catalogue(target, info);
    return written(target, false);
}

} // namespace rhombloom
