// Prints what dxflib reads in a DXF file, as JSON: a second opinion for dxf_check.py.
#include <cstdio>
#include <map>
#include <string>

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

namespace {

struct Reader : DL_CreationAdapter
{
    int polylines = 0, closed = 0, bulges = 0, units = -1;
    std::map<std::string, int> layers;

    void addPolyline(const DL_PolylineData& data) override
    {
        ++polylines;
        closed += data.flags & 1;
        ++layers[attributes.getLayer()];
    }
    void addVertex(const DL_VertexData& data) override { bulges += data.bulge != 0; }
    void setVariableInt(const std::string& name, int value, int) override
    {
        units = name == "$INSUNITS" ? value : units;
    }
};

} // namespace

int main(int argc, char** argv)
{
    Reader reader;
    DL_Dxf dxf;
    if (argc != 2 || !dxf.in(argv[1], &reader)) {
        return 1;
    }
    std::printf("{\"polylines\": %d, \"closed\": %d, \"bulges\": %d, \"units\": %d, \"layers\": {", reader.polylines,
                reader.closed, reader.bulges, reader.units);
    const char* separator = "";
    for (const auto& [name, count] : reader.layers) {
        std::printf("%s\"%s\": %d", separator, name.c_str(), count);
        separator = ", ";
    }
    std::printf("}}\n");
}
