#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/design/design_file.h"

//! The example designs, for benchmarks. RHOMBLOOM_SOURCE_DIR is where the sources are.
namespace rhombloom::bench {

inline std::vector<std::string> example_names()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(RHOMBLOOM_SOURCE_DIR "/examples")) {
        if (entry.path().extension() == ".json") {
            names.push_back(entry.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

inline Design example(const std::string& name)
{
    std::stringstream text;
    text << std::ifstream(RHOMBLOOM_SOURCE_DIR "/examples/" + name + ".json").rdbuf();
    return parse_design(text.str()).value();
}

} // namespace rhombloom::bench
