#pragma once

#include <chrono>
#include <string>

#include "core/design/history.h"
#include "exporters/save.h"

namespace rhombloom::cli {

//! \brief Progress on stderr: only on a terminal, and only once the work has taken a while.
class Progress
{
public:
    //! \param patience  how long the work must last before anything is shown; 0 for what is known to be long
    explicit Progress(std::chrono::milliseconds patience = std::chrono::milliseconds(400));
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress(); //!< wipes the line

    void show(const std::string& what);

private:
    bool terminal_;
    std::chrono::milliseconds patience_;
    std::chrono::steady_clock::time_point start_;
};

//! \brief Read and parse a design file; refusals begin with the file's name.
Expected<Design> load_design(const std::string& path);

//! \brief Replay with progress; refusals begin with the file's name.
Expected<Replay> replay_design(const std::string& path, const Design& design, Progress& progress);

//! \brief Refuses an output that is the file which was read.
Expected<void> spare_input(const std::string& input, const std::string& output);
Expected<void> spare_input(const std::string& input, const std::string& folder, const FileSet& files);

//! \brief Results go to stdout, after the line of progress is gone; a full disk or closed pipe is the machine's
//! failure.
Expected<void> print(const std::string& text);

} // namespace rhombloom::cli
