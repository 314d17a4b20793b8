// bench_embedding [--alone | --fast] [--csv FILE] [CASE ...]: the embedding's solver against general ones on the same
// energy, in one run, on one thread. Prints processor time (medians of the repeats) until the energy is within 1e-6 of
// the best that anybody found and until no gradient component exceeds 1e-8, and how the ratios compare with what must
// hold. CASE: a name, or a kind like plain- (embedding_cases.h); --alone: no rivals; --fast: without Ceres and
// projected Newton; --csv: append the times to FILE, for embedding_plot.py.

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>

#include "tests/bench/embedding_cases.h"
#include "tests/bench/embedding_rivals.h"

namespace rhombloom::bench {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double long_run = 5; // seconds; a solver that takes longer runs once

struct Settings
{
    bool alone = false;
    bool fast = false;
    std::string csv;
    std::vector<std::string> wanted;
};

// Milliseconds, one entry per repeat.
struct Times
{
    std::vector<double> to_energy, to_gradient;
};

using Results = std::map<std::string, std::map<std::string, Times>>; // by case and solver

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? never : values[values.size() / 2];
}

double first_time(const Trace& trace, const std::function<bool(const Sample&)>& reached)
{
    const auto found = std::find_if(trace.begin(), trace.end(), reached);
    return found == trace.end() ? never : 1e3 * found->seconds;
}

std::vector<Solver> solvers(const Case& test, const Settings& settings)
{
    std::vector<Solver> out = {ours()};
    if (settings.alone || !test.rivals) {
        return out;
    }
    out.push_back(liblbfgs());
    if (!settings.fast) {
        out.insert(out.end(), {projected_newton(), ceres_levenberg_marquardt(), ceres_dogleg()});
    }
    return out;
}

std::string cell(double milliseconds)
{
    char text[32];
    std::snprintf(text, sizeof text, std::isfinite(milliseconds) ? "%.2f" : "-", milliseconds);
    return text;
}

void print(const Case& test, const std::vector<Solver>& all, std::map<std::string, Times>& results)
{
    const Times& reference = results[all[0].name];
    std::printf("%s\n  %-28s %12s %12s %12s %16s\n", test.name.c_str(), "", "1e-6 (ms)", "1e-8 (ms)", "1e-6 : ours",
                "1e-6 : 1e-8 ours");
    for (const Solver& solver : all) {
        const double energy = median(results[solver.name].to_energy);
        const double gradient = median(results[solver.name].to_gradient);
        std::printf("  %-28s %12s %12s %12s %16s\n", solver.name.c_str(), cell(energy).c_str(), cell(gradient).c_str(),
                    cell(energy / median(reference.to_energy)).c_str(),
                    cell(energy / median(reference.to_gradient)).c_str());
    }
    std::fflush(stdout);
}

std::map<std::string, Times> measure(const Case& test, const std::vector<Solver>& all)
{
    std::map<std::string, Times> results;
    std::vector<bool> is_long(all.size(), false);
    for (int repeat = 0; repeat < test.repeats; ++repeat) {
        const Start start = test.make(repeat + 1);
        std::map<std::string, Trace> traces;
        double best = never;
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (is_long[k]) {
                continue;
            }
            Trace& trace = traces[all[k].name] = all[k].run(start.terms, start.x, test.limit_s);
            is_long[k] = trace.back().seconds > long_run;
            for (const Sample& sample : trace) {
                best = std::min(best, sample.energy);
            }
        }
        for (const auto& [name, trace] : traces) {
            results[name].to_energy.push_back(
                first_time(trace, [&](const Sample& s) { return s.energy <= best * (1 + 1e-6); }));
            results[name].to_gradient.push_back(
                first_time(trace, [](const Sample& s) { return s.gradient_norm <= 1e-8; }));
        }
    }
    return results;
}

void append_csv(const Settings& settings, const Results& results)
{
    std::FILE* file = settings.csv.empty() ? nullptr : std::fopen(settings.csv.c_str(), "a");
    if (file == nullptr) {
        return;
    }
    for (const auto& [test, solvers] : results) {
        for (const auto& [solver, times] : solvers) {
            std::fprintf(file, "%s;%s;%s;%s\n", test.c_str(), solver.c_str(), cell(median(times.to_energy)).c_str(),
                         cell(median(times.to_gradient)).c_str());
        }
    }
    std::fclose(file);
}

// One line per ratio that must hold: the rival's time to the energy, by ours to the gradient.
void judge_rival(const Results& results, const std::string& test, const std::string& rival, double least)
{
    const auto found = results.find(test);
    if (found == results.end() || !found->second.contains(rival)) {
        return;
    }
    const double ours_ms = median(found->second.at("rhombloom").to_gradient);
    const double ratio = median(found->second.at(rival).to_energy) / ours_ms;
    std::printf("%-6s %s: %s 1e-6 : ours 1e-8 = %s, at least %.2f\n", ratio >= least ? "holds" : "MISSED", test.c_str(),
                rival.c_str(), std::isinf(ratio) && std::isfinite(ours_ms) ? "never" : cell(ratio).c_str(), least);
}

void judge(const Results& results)
{
    for (const char* test : {"move-480", "move-588"}) {
        judge_rival(results, test, "liblbfgs", 1);
        judge_rival(results, test, "Ceres LM", 6);
    }
    judge_rival(results, "noise-1920", "liblbfgs", 1 / 0.7);
    judge_rival(results, "noise-1920", "Ceres LM", 14);
    const auto first = results.find("plain-1920");
    for (int elements = 7680; first != results.end() && elements <= 122880; elements *= 4) {
        const auto found = results.find("plain-" + std::to_string(elements));
        if (found != results.end()) {
            const double power = std::log(median(found->second.at("rhombloom").to_gradient) /
                                          median(first->second.at("rhombloom").to_gradient)) /
                                 std::log(elements / 1920.0);
            std::printf("%-6s plain-1920 to plain-%d: time grows as n^%.2f, at most n^1.50\n",
                        power <= 1.5 ? "holds" : "MISSED", elements, power);
        }
    }
}

Settings settings_from(int argc, char** argv)
{
    Settings settings;
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        if (word == "--fast") {
            settings.fast = true;
        } else if (word == "--alone") {
            settings.alone = true;
        } else if (word == "--csv" && k + 1 < argc) {
            settings.csv = argv[++k];
        } else {
            settings.wanted.push_back(word);
        }
    }
    return settings;
}

bool is_wanted(const Case& test, const Settings& settings)
{
    return settings.wanted.empty() ||
           std::any_of(settings.wanted.begin(), settings.wanted.end(), [&](const std::string& word) {
               return word.ends_with('-') ? test.name.starts_with(word) : test.name == word;
           });
}

} // namespace
} // namespace rhombloom::bench

int main(int argc, char** argv)
{
    using namespace rhombloom::bench;
    omp_set_max_active_levels(0); // CHOLMOD's teams make Ceres slower, not faster
    omp_set_num_threads(1);
    const Settings settings = settings_from(argc, argv);
    Results results;
    for (const Case& test : cases()) {
        if (is_wanted(test, settings)) {
            const std::vector<Solver> all = solvers(test, settings);
            results[test.name] = measure(test, all);
            print(test, all, results[test.name]);
        }
    }
    append_csv(settings, results);
    judge(results);
}
