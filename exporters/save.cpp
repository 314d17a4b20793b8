#include "exporters/save.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace rhombloom {

namespace fs = std::filesystem;

namespace {

bool path_exists(const fs::path& path)
{
    std::error_code error;
    return fs::exists(path, error);
}

bool path_is_folder(const fs::path& path)
{
    std::error_code error;
    return fs::is_directory(path, error);
}

bool path_is_regular(const fs::path& path)
{
    std::error_code error;
    return fs::is_regular_file(path, error);
}

std::string reason(int error)
{
    return std::strerror(error);
}

//! Where the bytes of \p path belong: what a symbolic link points to, so that the link stays.
fs::path behind_links(const fs::path& path)
{
    std::error_code error;
    const fs::path real = fs::is_symlink(path, error) ? fs::canonical(path, error) : path;
    return error ? path : real;
}

//! A name beside \p target that no other run and no other thread uses, however long the target's own is.
std::string temporary_name(const fs::path& target)
{
    static std::atomic<unsigned> count = 0;
    const std::string name = ".rhombloom-" + std::to_string(::getpid()) + "-" + std::to_string(++count) + ".tmp";
    return (target.parent_path() / name).string();
}

//! While it lives, Ctrl-C and the like wait: what is being written gets whole, and no temporary file stays behind.
class UninterruptedWriting
{
public:
    UninterruptedWriting()
    {
        sigset_t ends;
        sigemptyset(&ends);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            sigaddset(&ends, signal);
        }
        pthread_sigmask(SIG_BLOCK, &ends, &before_);
    }
    UninterruptedWriting(const UninterruptedWriting&) = delete;
    UninterruptedWriting& operator=(const UninterruptedWriting&) = delete;
    ~UninterruptedWriting() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

private:
    sigset_t before_;
};

//! While it lives, other runs that write into the folder wait, so that their files do not mix with ours.
class FolderLock
{
public:
    explicit FolderLock(const fs::path& folder)
        : folder_(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
    {
        if (folder_ >= 0) {
            ::flock(folder_, LOCK_EX);
        }
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock()
    {
        if (folder_ >= 0) {
            ::close(folder_);
        }
    }

private:
    int folder_;
};

//! A file under a temporary name; it vanishes unless it is given its real name.
class TemporaryFile
{
public:
    explicit TemporaryFile(const fs::path& target)
        : target_(behind_links(target).string()), name_(temporary_name(target_))
    {
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    TemporaryFile(TemporaryFile&& other) noexcept : target_(std::move(other.target_)), name_(std::move(other.name_))
    {
        other.name_.clear();
    }
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile()
    {
        if (!name_.empty()) {
            ::unlink(name_.c_str());
        }
    }

    Expected<void> write(const std::string& bytes)
    {
        ::unlink(name_.c_str()); // of a run that was killed and had the same number
        const int file = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0) {
            return failed(errno);
        }
        int error = 0;
        for (std::size_t done = 0; done < bytes.size() && error == 0;) {
            const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
            n < 0 ? void(error = errno == EINTR ? 0 : errno) : void(done += static_cast<std::size_t>(n));
        }
        error = error == 0 && ::fsync(file) != 0 ? errno : error;
        error = ::close(file) != 0 && error == 0 ? errno : error;
        return error == 0 ? Expected<void>{} : failed(error);
    }

    Expected<void> rename()
    {
        if (::rename(name_.c_str(), target_.c_str()) != 0) {
            return failed(errno);
        }
        name_.clear();
        return {};
    }

private:
    Expected<void> failed(int error) const { return machine_failure("cannot write " + target_ + ": " + reason(error)); }

    std::string target_;
    std::string name_;
};

Expected<void> make_folders(const fs::path& folder, std::vector<fs::path>& made)
{
    if (folder.empty() || path_is_folder(folder)) {
        return {};
    }
    if (auto ok = make_folders(folder.parent_path(), made); !ok) {
        return ok;
    }
    std::error_code error;
    if (!fs::create_directory(folder, error)) {
        if (path_is_folder(folder)) {
            return {}; // another run was quicker
        }
        const bool file_in_the_way = path_exists(folder);
        return machine_failure("cannot make the folder " + folder.string() + ": " +
                               (file_in_the_way ? "a file of that name stands there" : error.message()));
    }
    made.push_back(folder);
    return {};
}

void remove_folders(const std::vector<fs::path>& made)
{
    for (auto folder = made.rbegin(); folder != made.rend(); ++folder) {
        std::error_code ignored;
        fs::remove(*folder, ignored);
    }
}

Expected<void> write_all(const fs::path& folder, const FileSet& files, std::vector<fs::path>& made)
{
    std::vector<TemporaryFile> written;
    for (const auto& [name, bytes] : files) {
        const fs::path path = folder / name;
        if (auto ok = make_folders(path.parent_path(), made); !ok) {
            return ok;
        }
        if (path_is_folder(path)) {
            return machine_failure("cannot write " + path.string() + ": a folder of that name stands there");
        }
        written.emplace_back(path);
        if (auto ok = written.back().write(bytes); !ok) {
            return ok;
        }
    }
    const FolderLock alone(folder);
    for (TemporaryFile& file : written) {
        if (auto ok = file.rename(); !ok) {
            return ok;
        }
    }
    return {};
}

} // namespace

Expected<void> save_file(const std::string& path, const std::string& bytes)
{
    if (path_is_folder(path)) {
        return machine_failure("cannot write " + path + ": it is a folder; give a file name");
    }
    // A pipe or a device (/dev/full) has no bytes to keep: written straight.
    if (path_exists(path) && !path_is_regular(path)) {
        std::ofstream out(path, std::ios::binary);
        out << bytes;
        out.flush();
        return out ? Expected<void>{} : machine_failure("cannot write " + path + ": " + reason(errno));
    }
    const UninterruptedWriting whole;
    TemporaryFile file(path);
    if (auto ok = file.write(bytes); !ok) {
        return ok;
    }
    return file.rename();
}

Expected<void> save_folder(const std::string& folder, const FileSet& files)
{
    const UninterruptedWriting whole;
    std::vector<fs::path> made;
    auto ok = write_all(fs::path(folder), files, made);
    if (!ok) {
        remove_folders(made); // only the empty ones go
    }
    return ok;
}

std::string file_ending(const std::string& path)
{
    std::string ending = fs::path(path).extension().string().erase(0, 1);
    for (char& c : ending) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return ending;
}

Expected<std::string> load_file(const std::string& path, std::size_t max_bytes)
{
    if (!path_exists(path)) {
        return refuse(path + " does not exist");
    }
    if (path_is_folder(path)) {
        return refuse(path + " is a folder: give the file itself");
    }
    std::ifstream in(path, std::ios::binary);
    std::string bytes;
    std::vector<char> block(1 << 16);
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0) {
        bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
        if (bytes.size() > max_bytes) {
            return refuse(path + " is larger than " + std::to_string(max_bytes / 1000000) +
                          " MB: that cannot be the right file");
        }
    }
    if (!in.is_open() || in.bad()) {
        return refuse(path + " cannot be read: check its permissions");
    }
    return bytes;
}

} // namespace rhombloom
