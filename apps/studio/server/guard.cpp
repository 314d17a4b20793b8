#include "apps/studio/server/guard.h"

#include <algorithm>
#include <random>

namespace rhombloom::studio {

Guard::Guard(int port, std::string token) : token_(std::move(token))
{
    for (const char* name : {"127.0.0.1:", "localhost:"}) {
        hosts_.push_back(name + std::to_string(port));
    }
}

bool Guard::is_our_host(const std::vector<std::string>& host) const
{
    return host.size() == 1 && std::find(hosts_.begin(), hosts_.end(), host.front()) != hosts_.end();
}

bool Guard::is_our_origin(const std::vector<std::string>& origin, const std::string& host) const
{
    return origin.size() == 1 && origin.front() == "http://" + host;
}

//! Takes the same time wherever the first wrong letter stands.
bool Guard::has_token(const std::vector<std::string>& token) const
{
    if (token.size() != 1 || token.front().size() != token_.size()) {
        return false;
    }
    unsigned char difference = 0;
    for (std::size_t i = 0; i < token_.size(); ++i) {
        difference |= static_cast<unsigned char>(token.front()[i] ^ token_[i]);
    }
    return difference == 0;
}

int Guard::refusal(const Provenance& from) const
{
    constexpr int misdirected = 421;
    constexpr int forbidden = 403;
    constexpr int not_allowed = 405;
    if (!is_our_host(from.host)) {
        return misdirected;
    }
    const bool reads = from.method == "GET" || from.method == "HEAD";
    if (!reads && from.method != "POST") {
        return not_allowed;
    }
    const bool foreign =
        from.fetch_site.size() > 1 || (from.fetch_site.size() == 1 && from.fetch_site[0] != "same-origin" &&
                                       !(reads && from.fetch_site[0] == "none"));
    if (foreign || ((!reads || !from.origin.empty()) && !is_our_origin(from.origin, from.host.front()))) {
        return forbidden;
    }
    const bool for_program = from.path.starts_with("/api/");
    return (for_program || !reads) && !has_token(from.token) ? forbidden : 0;
}

std::string random_token()
{
    std::random_device device;
    constexpr int words = 4;
    std::string text;
    for (int i = 0; i < words; ++i) {
        for (unsigned word = device(), k = 0; k < 8; ++k, word >>= 4) {
            text += "0123456789abcdef"[word & 15];
        }
    }
    return text;
}

} // namespace rhombloom::studio
