// This work is based on "Interactive Surface Design with Interlocking Elements" (Skouras, Coros, Grinspun,
// Thomaszewski 2015), Sections 4.1 and 4.2.
#include "core/design/merge_seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace rhombloom {

namespace {

constexpr int most_zips = 4;
constexpr double off_union_weight = 0.25; // per la of summed depth
constexpr double zip_weight = 0.15;       // per mountain made one
constexpr double margin_weight = 1.0;     // at the limit of the permissible defects, fading over comfortable_margin
constexpr double asymmetry_weight = 2.0;  // per la
constexpr double comfortable_margin = radians(40);

Vec3 mean(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) {
        sum += p;
    }
    return sum / static_cast<double>(points.size());
}

//! What is needed of one surface's interfaces again and again.
class InterfaceList
{
public:
    InterfaceList(const std::vector<MergeInterface>& interfaces, const DefectRange& limits, int zip_variants)
        : interfaces_(interfaces), limits_(limits), zip_variants_(zip_variants)
    {
        for (const MergeInterface& one : interfaces) {
            middles_.emplace_back();
            for (const Interface& loop : one.cut.loops) {
                middles_.back().push_back(mean(loop.points));
            }
        }
    }

    int size() const { return static_cast<int>(interfaces_.size()); }
    const MergeInterface& operator[](int i) const { return interfaces_[i]; }
    const std::vector<Vec3>& middles(int i) const { return middles_[i]; }

    //! A loop of an interface in the ways in which it can be shortened, made when first asked for.
    const std::vector<Interface>& shortened(int i, int loop, int size)
    {
        const auto [place, fresh] = variants_.try_emplace({i, loop, size});
        if (fresh) {
            place->second = rhombloom::shortened(interfaces_[i].cut.loops[loop], size, limits_, zip_variants_);
        }
        return place->second;
    }

private:
    const std::vector<MergeInterface>& interfaces_;
    DefectRange limits_;
    int zip_variants_;
    std::vector<std::vector<Vec3>> middles_;
    std::map<std::array<int, 3>, std::vector<Interface>> variants_;
};

//! The sum of squared distances of the matched vertices, or infinity when it exceeds \p most.
double squares(const Interface& a, const Interface& b, int shift, double most)
{
    const int n = a.size();
    double sum = 0;
    for (int i = 0; i < n && sum < most; ++i) {
        sum += (a.points[i] - b.points[(shift - i + 2 * n) % n]).squaredNorm();
    }
    return sum < most ? sum : 1e300;
}

//! The compatible correspondence whose vertices are closest as posed; every way to zip the larger loop is tried.
std::optional<SeamChoice> best_seam(const std::vector<Interface>& as, const std::vector<Interface>& bs,
                                    const DefectRange& limits)
{
    std::optional<SeamChoice> best;
    double least = 1e300;
    const Interface* best_a = nullptr;
    const Interface* best_b = nullptr;
    Correspondence match;
    for (const Interface& a : as) {
        for (const Interface& b : bs) {
            for (int shift = 0; shift < a.size(); ++shift) {
                const auto compatible = correspondence(a, b, shift, limits);
                const double sum = compatible ? squares(a, b, shift, least) : 1e300;
                if (sum < least) {
                    least = sum;
                    best_a = &a;
                    best_b = &b;
                    match = *compatible;
                }
            }
        }
    }
    if (best_a != nullptr) {
        best = SeamChoice{0, 0, *best_a, *best_b, match, least};
    }
    return best;
}

//! Which loop of b each loop of a is matched with: the nearest that is still free.
std::vector<int> nearest_loops(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    std::vector<int> result;
    for (const Vec3& middle : a) {
        int nearest = -1;
        for (int j = 0; j < static_cast<int>(b.size()); ++j) {
            const bool taken = std::find(result.begin(), result.end(), j) != result.end();
            if (!taken && (nearest < 0 || (middle - b[j]).norm() < (middle - b[nearest]).norm())) {
                nearest = j;
            }
        }
        result.push_back(nearest);
    }
    return result;
}

struct Pair
{
    int a = 0;
    int b = 0;
    double bound = 0; //!< on the score
};

//! Pairs with equally many loops of not too different sizes, those first that can be best.
std::vector<Pair> ordered_pairs(const InterfaceList& a, const InterfaceList& b, const Element& element)
{
    std::vector<Pair> pairs;
    for (int i = 0; i < a.size(); ++i) {
        for (int j = 0; j < b.size(); ++j) {
            if (a.middles(i).size() != b.middles(j).size()) {
                continue;
            }
            Pair pair{i, j, off_union_weight * (a[i].off_union + b[j].off_union) / element.la};
            if (a.middles(i).size() == 1) {
                const int difference = std::abs(a[i].cut.loops[0].size() - b[j].cut.loops[0].size());
                if (difference > 2 * most_zips) {
                    continue;
                }
                // The rms distance of two loops is at least the distance of their middles; zips hardly move these.
                const double way = (a.middles(i)[0] - b.middles(j)[0]).norm();
                pair.bound += zip_weight * difference / 2 + (difference == 0 ? way : 0.5 * way) / element.la;
            }
            pairs.push_back(pair);
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.bound < y.bound; });
    return pairs;
}

std::optional<MergeChoice> match_loops(InterfaceList& a, InterfaceList& b, const Pair& pair, const DefectRange& limits)
{
    MergeChoice result;
    result.a = &a[pair.a];
    result.b = &b[pair.b];
    const std::vector<int> partners = nearest_loops(a.middles(pair.a), b.middles(pair.b));
    for (int i = 0; i < static_cast<int>(partners.size()); ++i) {
        const int size_a = result.a->cut.loops[i].size();
        const int size_b = result.b->cut.loops[partners[i]].size();
        const int size = std::min(size_a, size_b);
        if (std::abs(size_a - size_b) > 2 * most_zips || size < 4) {
            return std::nullopt;
        }
        auto seam = best_seam(a.shortened(pair.a, i, size), b.shortened(pair.b, partners[i], size), limits);
        if (!seam) {
            return std::nullopt;
        }
        seam->loop_a = i;
        seam->loop_b = partners[i];
        result.seams.push_back(std::move(*seam));
    }
    return result;
}

//! All numbers but the asymmetry.
void rate(MergeChoice& choice, const Element& element, const DefectRange& limits)
{
    double sum = 0;
    choice.min_defect = 1e300;
    choice.max_defect = -1e300;
    for (const SeamChoice& seam : choice.seams) {
        sum += seam.squares;
        choice.loop_size += seam.a.size();
        choice.zips += static_cast<int>(seam.a.zipped.size() + seam.b.zipped.size());
        choice.min_defect = std::min(choice.min_defect, seam.match.min_defect);
        choice.max_defect = std::max(choice.max_defect, seam.match.max_defect);
    }
    choice.distance = std::sqrt(sum / choice.loop_size);
    choice.off_union = choice.a->off_union + choice.b->off_union;
    const double margin = std::min(choice.min_defect - limits.min, limits.max - choice.max_defect);
    choice.score = choice.distance / element.la + off_union_weight * choice.off_union / element.la +
                   zip_weight * choice.zips + margin_weight * std::max(0.0, 1 - margin / comfortable_margin);
}

//! How far the merged vertices of a seam that meets the plane or axis are from being their own images.
double asymmetry(const std::vector<SeamChoice>& seams, const Symmetry& symmetry, double la)
{
    std::vector<Vec3> points;
    for (const SeamChoice& seam : seams) {
        for (int i = 0; i < seam.a.size(); ++i) {
            points.push_back((seam.a.points[i] + seam.b.points[partner(seam.match, i, seam.a.size())]) / 2);
        }
    }
    const Vec3 middle = mean(points);
    double worst = 0;
    for (const SymmetryImage& image : images(symmetry)) {
        if ((image.map * middle - middle).norm() > 0.6 * la) {
            continue;
        }
        double sum = 0;
        for (const Vec3& p : points) {
            double nearest = 1e300;
            for (const Vec3& q : points) {
                nearest = std::min(nearest, (image.map * p - q).squaredNorm());
            }
            sum += nearest;
        }
        worst = std::max(worst, std::sqrt(sum / static_cast<double>(points.size())));
    }
    return worst;
}

void sort_by_score(std::vector<MergeChoice>& choices)
{
    std::stable_sort(choices.begin(), choices.end(), [](const MergeChoice& x, const MergeChoice& y) {
        return std::lround(x.score * 1e6) < std::lround(y.score * 1e6);
    });
}

} // namespace

std::vector<MergeChoice> best_choices(const std::vector<MergeInterface>& a, const std::vector<MergeInterface>& b,
                                      const Element& element, const SeamOptions& options)
{
    const DefectRange limits = permissible_defect(element);
    InterfaceList first(a, limits, options.zip_variants);
    InterfaceList second(b, limits, options.zip_variants);
    const bool symmetric = options.symmetry.kind != Symmetry::Kind::None;
    const std::size_t wanted = options.count * (symmetric ? 4 : 1);
    std::vector<MergeChoice> result;
    std::vector<double> scores; // so far, ascending, at most as many as wanted
    int tried = 0;
    for (const Pair& pair : ordered_pairs(first, second, element)) {
        const double worst = scores.size() < wanted ? 1e300 : scores.back();
        if (pair.bound > worst || tried++ == options.pairs) {
            break; // the pairs that follow can only be worse
        }
        auto choice = match_loops(first, second, pair, limits);
        if (!choice) {
            continue;
        }
        rate(*choice, element, limits);
        if (choice->score < worst) {
            scores.insert(std::upper_bound(scores.begin(), scores.end(), choice->score), choice->score);
            scores.resize(std::min(scores.size(), wanted));
            result.push_back(std::move(*choice));
        }
    }
    sort_by_score(result);
    result.resize(std::min(result.size(), wanted));
    if (symmetric) {
        for (MergeChoice& choice : result) {
            choice.asymmetry = asymmetry(choice.seams, options.symmetry, element.la);
            choice.score += asymmetry_weight * choice.asymmetry / element.la;
        }
        sort_by_score(result);
    }
    return result;
}

} // namespace rhombloom
