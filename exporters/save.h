#pragma once

#include <map>
#include <string>

#include "core/expected.h"

namespace rhombloom {

//! \brief Relative paths ("cut/sheet-01.svg") and the bytes of each file.
using FileSet = std::map<std::string, std::string>;

//! \brief Write one file whole or not at all: a temporary name beside it, then rename.
Expected<void> save_file(const std::string& path, const std::string& bytes);

//! \brief Write all files into \p folder or, when any cannot be written, change nothing there.
Expected<void> save_folder(const std::string& folder, const FileSet& files);

//! \brief The whole file; the refusal tells a missing file, a folder and an unreadable or oversized file apart.
Expected<std::string> load_file(const std::string& path, std::size_t max_bytes);

//! \brief "stl" of "a/Cup.STL"; empty when the name has no ending.
std::string file_ending(const std::string& path);

} // namespace rhombloom
