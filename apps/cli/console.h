#pragma once

#include <chrono>
#include <string>

#include "core/design/history.h"

namespace rhombloom::cli {

//! \brief Progress on stderr: only on a terminal, and only once the work has taken a while.
class Progress
{
public:
    Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress(); //!< wipes the line

    void show(const std::string& what);

private:
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_;
};

//! \brief Read and parse a design file; refusals begin with the file's name.
Expected<Design> load_design(const std::string& path);

//! \brief Replay with progress; refusals begin with the file's name.
Expected<Replay> replay_design(const std::string& path, const Design& design, Progress& progress);

//! \brief Results go to stdout; a full disk or closed pipe is the machine's failure.
Expected<void> print(const std::string& text);

} // namespace rhombloom::cli
