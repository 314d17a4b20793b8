#include <algorithm>
#include <map>

#include "exporters/pdf_embed_font.h"
#include "exporters/pdf_objects.h"

#define POINTERHOLDER_TRANSITION 4 // qpdf 11: std::shared_ptr only
#include <qpdf/QPDF.hh>

#include "core/text.h"

namespace rhombloom {

namespace {

using Object = QPDFObjectHandle;

Object name(const std::string& text)
{
    return Object::newName(text);
}

//! A document being put together.
class Builder
{
public:
    Builder(const PaperSize& paper, std::vector<PdfPage> pages) : paper_(paper), pages_(std::move(pages))
    {
        pdf_.emptyPDF();
    }

    std::string build(const PdfFont& font, const DocumentInfo& info)
    {
        add_streams(font);
        add_pages();
        add_links();
        add_structure();
        add_bookmarks();
        add_labels();
        describe_document(pdf_, info);
        return written(pdf_);
    }

private:
    Object stream(const std::string& data, Object dictionary)
    {
        Object made = Object::newStream(&pdf_);
        made.replaceDict(dictionary);
        made.replaceStreamData(data, name("/FlateDecode"), Object::newNull());
        return made;
    }

    Object indirect(const std::string& dictionary) { return pdf_.makeIndirectObject(Object::parse(dictionary)); }

    //! All that is packed, packed at once: the pages' contents, their groups, the font.
    void add_streams(const PdfFont& font)
    {
        std::vector<std::string> texts;
        std::set<char32_t> used;
        for (PdfPage& page : pages_) {
            texts.push_back(page_start() + std::move(page.content));
            used.insert(page.characters.begin(), page.characters.end());
            for (const auto& group : page.groups) {
                if (groups_.emplace(group.get(), Object()).second) {
                    in_order_.push_back(group.get());
                }
            }
        }
        for (const PdfGroup* group : in_order_) {
            texts.push_back(group->content);
        }
        const FontObjects objects = font_objects(font, used);
        texts.insert(texts.end(), {objects.file, objects.unicode_map, objects.glyph_set});
        const std::vector<std::string> packed = deflated(texts);
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            contents_.push_back(stream(packed[i], Object::newDictionary()));
        }
        for (std::size_t i = 0; i < in_order_.size(); ++i) {
            const std::string far = to_fixed(in_order_[i]->extent * pdf_units, 0);
            groups_[in_order_[i]] =
                stream(packed[pages_.size() + i], Object::parse("<</Type/XObject/Subtype/Form/BBox[-" + far + " -" +
                                                                far + " " + far + " " + far + "]/Resources<<>>>>"));
        }
        add_font(objects, {packed.end() - 3, packed.end()}, texts[texts.size() - 3].size());
    }

    //! Sixteenths of a point with y down; round pens.
    std::string page_start() const { return ".0625 0 0 -.0625 0 " + to_fixed(paper_.height, 4) + " cm 1 J 1 j\n"; }

    void add_font(const FontObjects& objects, const std::vector<std::string>& packed, std::size_t file_size)
    {
        Object descriptor = indirect(objects.descriptor);
        descriptor.replaceKey("/FontFile2",
                              stream(packed[0], Object::parse("<</Length1 " + std::to_string(file_size) + ">>")));
        descriptor.replaceKey("/CIDSet", stream(packed[2], Object::newDictionary()));
        Object glyphs = indirect(objects.glyphs);
        glyphs.replaceKey("/FontDescriptor", descriptor);
        font_ = indirect(objects.font);
        font_.replaceKey("/DescendantFonts", Object::newArray({glyphs}));
        font_.replaceKey("/ToUnicode", stream(packed[1], Object::newDictionary()));
    }

    void add_pages()
    {
        Object tree = pdf_.getRoot().getKey("/Pages");
        tree.replaceKey("/MediaBox",
                        Object::parse("[0 0 " + to_fixed(paper_.width, 4) + " " + to_fixed(paper_.height, 4) + "]"));
        Object kids = Object::newArray();
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            Object page = indirect("<</Type/Page/Tabs/S/StructParents " + std::to_string(i) + ">>");
            page.replaceKey("/Parent", tree);
            page.replaceKey("/Contents", contents_[i]);
            page.replaceKey("/Resources", resources(pages_[i]));
            kids.appendItem(page);
            made_.push_back(page);
        }
        tree.replaceKey("/Kids", kids);
        tree.replaceKey("/Count", Object::newInteger(static_cast<int>(pages_.size())));
    }

    Object resources(const PdfPage& page)
    {
        Object result = Object::newDictionary();
        if (!page.characters.empty()) {
            result.replaceKey("/Font", Object::newDictionary({{"/F", font_}}));
        }
        if (!page.groups.empty()) {
            Object forms = Object::newDictionary();
            for (std::size_t i = 0; i < page.groups.size(); ++i) {
                forms.replaceKey("/G" + std::to_string(i), groups_[page.groups[i].get()]);
            }
            result.replaceKey("/XObject", forms);
        }
        return result;
    }

    Object position(std::size_t page, double top)
    {
        return Object::newArray({made_[page], name("/XYZ"), Object::newNull(),
                                 Object::newReal(to_fixed(paper_.height - top, 1)), Object::newNull()});
    }

    void add_links()
    {
        std::map<std::string, std::pair<std::size_t, double>> places;
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            for (const auto& [destination, top] : pages_[i].destinations) {
                places[destination] = {i, top};
            }
        }
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            Object list = Object::newArray();
            for (const PdfLink& link : pages_[i].links) {
                const auto to = places.find(link.destination);
                expects(to != places.end(), "pdf_document: a link leads somewhere");
                list.appendItem(annotation(link, position(to->second.first, to->second.second)));
            }
            if (!pages_[i].links.empty()) {
                made_[i].replaceKey("/Annots", list);
            }
        }
    }

    Object annotation(const PdfLink& link, Object to)
    {
        std::string box;
        for (const double v :
             {link.box.min.x(), paper_.height - link.box.max.y(), link.box.max.x(), paper_.height - link.box.min.y()}) {
            box += to_fixed(v, 1) + " ";
        }
        Object made = indirect("<</Type/Annot/Subtype/Link/F 4/Border[0 0 0]/Rect[" + box + "]>>"); // F 4: is printed
        made.replaceKey("/Dest", to);
        return made;
    }

    void add_structure()
    {
        Object root = indirect("<</Type/StructTreeRoot>>");
        Object document = indirect("<</S/Document>>");
        document.replaceKey("/P", root);
        root.replaceKey("/K", document);
        Object numbers = Object::newArray();
        Object top = Object::newArray();
        Object section;
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            const PdfPage& page = pages_[i];
            const bool starts = page.section >= 0 && (i == 0 || pages_[i - 1].section != page.section);
            if (starts) {
                section = indirect("<</S/Sect/K[]>>");
                section.replaceKey("/P", document);
                top.appendItem(section);
            }
            std::vector<Object> marked(page.marks);
            Object kids = page.section >= 0 ? section.getKey("/K") : top;
            for (const PdfTag& tag : page.tags) {
                kids.appendItem(element(tag, page.section >= 0 ? section : document, i, marked));
            }
            numbers.appendItem(Object::newInteger(static_cast<int>(i)));
            numbers.appendItem(pdf_.makeIndirectObject(Object::newArray(marked)));
        }
        document.replaceKey("/K", top);
        for (std::size_t k = 0; k < link_elements_.size(); ++k) {
            numbers.appendItem(Object::newInteger(static_cast<int>(pages_.size() + k)));
            numbers.appendItem(link_elements_[k]);
        }
        root.replaceKey("/ParentTree", pdf_.makeIndirectObject(Object::newDictionary({{"/Nums", numbers}})));
        pdf_.getRoot().replaceKey("/StructTreeRoot", root);
        pdf_.getRoot().replaceKey("/MarkInfo", Object::parse("<</Marked true>>"));
    }

    Object element(const PdfTag& tag, Object parent, std::size_t page, std::vector<Object>& marked)
    {
        Object made = indirect("<</S/" + tag.tag + ">>");
        made.replaceKey("/P", parent);
        if (tag.mark >= 0) {
            made.replaceKey("/Pg", made_[page]);
            made.replaceKey("/K", Object::newInteger(tag.mark));
            marked[tag.mark] = made;
        }
        if (!tag.alternative.empty()) {
            made.replaceKey("/Alt", Object::newUnicodeString(tag.alternative));
        }
        if (tag.link >= 0) {
            Object link = made_[page].getKey("/Annots").getArrayItem(tag.link);
            link.replaceKey("/StructParent",
                            Object::newInteger(static_cast<int>(pages_.size() + link_elements_.size())));
            Object reference = Object::parse("<</Type/OBJR>>");
            reference.replaceKey("/Obj", link);
            made.replaceKey("/K", Object::newArray({Object::newInteger(tag.mark), reference}));
            link_elements_.push_back(made);
        }
        if (!tag.kids.empty()) {
            Object kids = Object::newArray();
            for (const PdfTag& kid : tag.kids) {
                kids.appendItem(element(kid, made, page, marked));
            }
            made.replaceKey("/K", kids);
        }
        return made;
    }

    //! Appends a bookmark to the list below its parent.
    void hang(Object item, Object parent)
    {
        item.replaceKey("/Parent", parent);
        if (parent.hasKey("/Last")) {
            Object before = parent.getKey("/Last");
            before.replaceKey("/Next", item);
            item.replaceKey("/Prev", before);
        } else {
            parent.replaceKey("/First", item);
        }
        parent.replaceKey("/Last", item);
    }

    void add_bookmarks()
    {
        Object root = indirect("<</Type/Outlines>>");
        Object chapter;
        int open = 0;
        int in_chapter = 0;
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            for (const PdfBookmark& mark : pages_[i].bookmarks) {
                Object item = indirect("<<>>");
                item.replaceKey("/Title", Object::newUnicodeString(mark.title));
                item.replaceKey("/Dest", position(i, mark.top));
                hang(item, mark.level == 0 ? root : chapter);
                in_chapter = mark.level == 0 ? 0 : in_chapter + 1;
                if (mark.level == 0) {
                    chapter = item;
                } else {
                    chapter.replaceKey("/Count", Object::newInteger(in_chapter));
                }
                ++open;
            }
        }
        if (open > 0) {
            root.replaceKey("/Count", Object::newInteger(open));
            pdf_.getRoot().replaceKey("/Outlines", root);
        }
    }

    //! Labels that are the page's number are said once for all that follow.
    void add_labels()
    {
        Object numbers = Object::newArray();
        bool counting = false;
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            const bool number = pages_[i].label == std::to_string(i + 1);
            if (number && counting) {
                continue;
            }
            counting = number;
            numbers.appendItem(Object::newInteger(static_cast<int>(i)));
            Object style = Object::newDictionary();
            if (number) {
                style.replaceKey("/S", name("/D"));
                style.replaceKey("/St", Object::newInteger(static_cast<int>(i) + 1));
            } else {
                style.replaceKey("/P", Object::newUnicodeString(pages_[i].label));
            }
            numbers.appendItem(style);
        }
        pdf_.getRoot().replaceKey("/PageLabels", Object::newDictionary({{"/Nums", numbers}}));
    }

    QPDF pdf_;
    PaperSize paper_;
    std::vector<PdfPage> pages_;
    std::map<const PdfGroup*, Object> groups_;
    std::vector<const PdfGroup*> in_order_; // of first use, not of addresses
    std::vector<Object> contents_;
    std::vector<Object> made_; // the pages
    std::vector<Object> link_elements_;
    Object font_;
};

} // namespace

Expected<std::string> pdf_document(const PdfFont& font, std::vector<PdfPage> pages, const PaperSize& paper,
                                   const DocumentInfo& info)
{
    for (const PdfPage& page : pages) {
        if (!page.problem.empty()) {
            return refuse(page.problem);
        }
    }
    return Builder(paper, std::move(pages)).build(font, info);
}

} // namespace rhombloom
