#pragma once

#include <map>
#include <string>

namespace rhombloom::studio {

//! \brief What the server asks of the studio: no type of any HTTP library.
struct Request
{
    std::string method;
    std::string path;
    std::map<std::string, std::string> query;
    std::string body;
};

struct Reply
{
    int status = 200;
    std::string type = "application/json";
    std::string body;
    std::map<std::string, std::string> headers = {}; //!< beyond those that every reply carries
};

} // namespace rhombloom::studio
