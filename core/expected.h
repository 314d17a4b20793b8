#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace rhombloom {

//! \brief A refusal that the user must hear: one sentence that names the place, the value and the remedy.
struct Error
{
    enum class Kind
    {
        Input,  //!< the input or the design is at fault (exit 1)
        Machine //!< the machine is: disk full, no permission (exit 3)
    };
    std::string message;
    Kind kind = Kind::Input;
};

template <class T>
using Expected = tl::expected<T, Error>;

inline tl::unexpected<Error> refuse(std::string message)
{
    return tl::make_unexpected(Error{std::move(message), Error::Kind::Input});
}

inline tl::unexpected<Error> machine_failure(std::string message)
{
    return tl::make_unexpected(Error{std::move(message), Error::Kind::Machine});
}

//! \brief State what a caller must guarantee. A violation is a bug and stops the program in every build.
inline void expects(bool condition, const char* what)
{
    if (!condition) {
        throw std::logic_error(std::string("broken expectation: ") + what);
    }
}

} // namespace rhombloom
