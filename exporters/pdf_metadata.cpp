#include "exporters/pdf_finish.h"

#include <charconv>
#include <cstdlib>
#include <ctime>

#include "exporters/pdf_objects.h"

#define POINTERHOLDER_TRANSITION 4 // qpdf 11: std::shared_ptr only
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>

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

    QPDFObjectHandle profile = QPDFObjectHandle::newStream(&pdf);
    profile.replaceStreamData(deflated({srgb_profile()})[0], name("/FlateDecode"), QPDFObjectHandle::newNull());
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

} // namespace

void describe_document(QPDF& pdf, const DocumentInfo& info)
{
    set_info(pdf, info);
    set_metadata(pdf, info);
    set_catalogue(pdf, info);
}

std::string written(QPDF& pdf)
{
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.setObjectStreamMode(qpdf_o_disable); // PDF/A-1 is PDF 1.4
    writer.setDecodeLevel(qpdf_dl_none);        // streams are packed already
    writer.setCompressStreams(false);
    writer.forcePDFVersion("1.4");
    writer.setDeterministicID(true);
    writer.setNewlineBeforeEndstream(true); // PDF/A-1 wants the end of line
    writer.write();
    const auto buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

} // namespace rhombloom
