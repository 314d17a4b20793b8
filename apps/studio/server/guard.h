#pragma once

#include <string>
#include <vector>

namespace rhombloom::studio {

//! \brief What a request says about where it comes from. Each header as often as it was sent.
struct Provenance
{
    std::string method;
    std::string path;
    std::vector<std::string> host;
    std::vector<std::string> origin;
    std::vector<std::string> fetch_site; //!< Sec-Fetch-Site, which pages cannot forge
    std::vector<std::string> token;      //!< X-Rhombloom-Token
};

//! \brief Who may talk to the studio: pages of this very server, opened with this run's token.
//! \details Any page in the browser and any name that resolves to this machine can reach a loopback port. The exact
//! Host keeps other names out (DNS rebinding); the Origin and the token, which only our page knows, keep other pages
//! out; no CORS header is ever sent.
class Guard
{
public:
    Guard(int port, std::string token);

    //! 0: allowed; else the HTTP status of the refusal.
    int refusal(const Provenance& from) const;

    const std::string& token() const { return token_; }

private:
    bool is_our_host(const std::vector<std::string>& host) const;
    bool is_our_origin(const std::vector<std::string>& origin, const std::string& host) const;
    bool has_token(const std::vector<std::string>& token) const;

    std::vector<std::string> hosts_;
    std::string token_;
};

//! \brief 128 random bits as text, new for every run.
std::string random_token();

} // namespace rhombloom::studio
