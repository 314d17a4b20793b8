#include "apps/studio/server/server.h"

#include <httplib.h>

#include "apps/studio/server/answers.h"
#include "apps/studio/server/guard.h"

namespace rhombloom::studio {

namespace {

constexpr std::size_t max_body = 8'000'000;
constexpr int seconds_to_arrive = 5; // of each piece
// A browser opens up to six connections at a time; but one that sends a byte now and then holds its thread.
constexpr int threads = 256;
// Else the rest of a request that was refused early, its body for example, would be read as the next request.
constexpr std::size_t requests_per_connection = 1;

constexpr const char* page_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
// Files of the kit are shown inside the page; preview.html brings a stricter policy of its own.
constexpr const char* kit_policy = "frame-ancestors 'self'";
constexpr const char* kit_page_policy = "sandbox allow-scripts; frame-ancestors 'self'";

std::vector<std::string> all(const httplib::Request& request, const char* name)
{
    std::vector<std::string> values;
    for (std::size_t k = 0; k < request.get_header_value_count(name); ++k) {
        values.push_back(request.get_header_value(name, k));
    }
    return values;
}

Provenance provenance(const httplib::Request& request)
{
    return {request.method,
            request.path,
            all(request, "Host"),
            all(request, "Origin"),
            all(request, "Sec-Fetch-Site"),
            all(request, "X-Rhombloom-Token")};
}

const char* policy(const std::string& path)
{
    if (path.starts_with("/kit/")) {
        return path.ends_with(".html") ? kit_page_policy : kit_policy;
    }
    return page_policy;
}

void put(const Reply& reply, const std::string& path, httplib::Response& response)
{
    response.status = reply.status;
    response.set_content(reply.body, reply.type);
    response.set_header("Content-Security-Policy", policy(path));
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Cross-Origin-Opener-Policy", "same-origin");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("Cache-Control", "no-store");
    for (const auto& [name, value] : reply.headers) {
        response.set_header(name, value);
    }
}

//! Its body is read before it is answered: a connection that is closed over unread bytes can lose the answer.
bool will_be_read(const httplib::Request& request)
{
    return request.method == "POST" && request.has_header("Content-Length");
}

Request translated(const httplib::Request& request)
{
    Request result{request.method, request.path, {}, request.body};
    for (const auto& [name, value] : request.params) {
        result.query[name] = value;
    }
    return result;
}

std::string page_type(const std::string& name)
{
    return name.ends_with(".js") ? "text/javascript" : name.ends_with(".css") ? "text/css" : "text/html";
}

Reply page(const FileSet& pages, const std::string& path)
{
    if (path == "/favicon.ico") {
        return {204, "image/x-icon", ""};
    }
    const auto found = pages.find(path == "/" ? "index.html" : path.substr(1));
    return found == pages.end() ? error_reply(404, "there is nothing at this address")
                                : Reply{200, page_type(found->first), found->second};
}

void set_limits(httplib::Server& server)
{
    server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
    server.set_payload_max_length(max_body);
    server.set_read_timeout(seconds_to_arrive);
    server.set_write_timeout(seconds_to_arrive);
    server.set_keep_alive_max_count(requests_per_connection);
    server.set_tcp_nodelay(true);
}

} // namespace

Expected<void> serve(Studio& studio, const ServerOptions& options)
{
    httplib::Server server;
    set_limits(server);
    const std::string host = "127.0.0.1";
    const int port = options.port == 0 ? server.bind_to_any_port(host)
                                       : (server.bind_to_port(host, options.port) ? options.port : -1);
    if (port <= 0) {
        return machine_failure("port " + std::to_string(options.port) + " is taken: choose another with --port");
    }
    const Guard guard(port, options.token);
    const auto refused = [&](const httplib::Request& request, httplib::Response& response) {
        const int refusal = guard.refusal(provenance(request));
        if (refusal != 0) {
            put(error_reply(refusal, "this request is not from the studio's own page"), request.path, response);
        }
        return refusal != 0;
    };
    server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
        using Next = httplib::Server::HandlerResponse;
        return !will_be_read(request) && refused(request, response) ? Next::Handled : Next::Unhandled;
    });
    const auto answer = [&](const httplib::Request& request, httplib::Response& response) {
        if (refused(request, response)) {
            return;
        }
        const bool program = request.path.starts_with("/api/") || request.path.starts_with("/kit/");
        const bool reads = request.method != "POST";
        put(program || !reads ? studio.handle(translated(request)) : page(options.pages, request.path), request.path,
            response);
    };
    server.Get(".*", answer);
    server.Post(".*", answer);
    server.set_error_handler([](const httplib::Request& request, httplib::Response& response) {
        if (response.body.empty()) {
            put(error_reply(response.status, "the request could not be read"), request.path, response);
        }
    });
    if (options.listening) {
        options.listening("http://" + host + ":" + std::to_string(port) + "/#" + options.token);
    }
    return server.listen_after_bind() ? Expected<void>() : machine_failure("the studio's server stopped");
}

Expected<FileSet> load_pages(const std::string& folder)
{
    FileSet pages;
    for (const char* name : {"index.html", "studio.js", "studio.css"}) {
        constexpr std::size_t largest = 20'000'000;
        auto bytes = load_file(folder + "/" + name, largest);
        if (!bytes) {
            return machine_failure("the studio's page has not been built (" + bytes.error().message +
                                   "): start it with ./rhombloom studio, or run apps/studio/web/build");
        }
        pages[name] = std::move(*bytes);
    }
    return pages;
}

} // namespace rhombloom::studio
