#include <algorithm>
#include <array>

#include "exporters/nesting_improve.h"

namespace rhombloom::nesting {

namespace {

//! Work for the fragment of one part of a room, in copies looked at.
constexpr double block_work = 1e4;
constexpr int cuts = 24;

//! A part of the room and what lies in it.
struct Block
{
    Vec2 corner = Vec2::Zero();
    Room room;
    Layout layout; //!< offsets from the room's corner
};

class Splitter
{
public:
    Splitter(const Piece& piece, const Room& room) : piece_(piece), trials_(trials_for(piece, room))
    {
        const double copies = room.width * room.height / piece.patterns.front().area_per_copy() + 20;
        const auto most = static_cast<std::size_t>(std::clamp(block_work / copies, 20.0, 300.0));
        // The aligned angles of the densest patterns come first; even steps are of no use in a narrow part.
        std::erase_if(trials_, [&](const Trial& t) { return t.even; });
        trials_.resize(std::min(trials_.size(), most));
    }

    Layout filled(const Room& room) const
    {
        Layout best;
        for (const Trial& trial : trials_) {
            Layout layout = fragment(*trial.pattern, trial.angle, piece_.hull, room, best.size() + 1);
            if (!layout.empty()) {
                best = std::move(layout);
            }
        }
        return best;
    }

    //! The best cut of \p block across \p axis (0: at some x), or \p block itself when no cut gains.
    std::vector<Block> split(const Block& block, std::size_t axis) const;

private:
    const Piece& piece_;
    std::vector<Trial> trials_;
};

std::vector<Block> Splitter::split(const Block& block, std::size_t axis) const
{
    std::vector<Block> best = {block};
    std::size_t most = block.layout.size();
    const std::array<double, 2> size = {block.room.width, block.room.height};
    double last_extent = 0;
    for (int i = 1; i < cuts; ++i) {
        Room near = block.room;
        (axis == 0 ? near.width : near.height) = size[axis] * i / cuts;
        Layout first = filled(near);
        if (first.empty()) {
            continue;
        }
        const double extent = upper_right(first, piece_)[static_cast<long>(axis)];
        if (extent == last_extent) {
            continue;
        }
        last_extent = extent;
        Room far = block.room;
        (axis == 0 ? far.width : far.height) = size[axis] - extent - piece_.spacing;
        if (std::min(far.width, far.height) <= 0) {
            continue;
        }
        Layout second = filled(far);
        if (first.size() + second.size() > most) {
            most = first.size() + second.size();
            (axis == 0 ? near.width : near.height) = extent;
            const Vec2 step = axis == 0 ? Vec2(extent + piece_.spacing, 0) : Vec2(0, extent + piece_.spacing);
            best = {{block.corner, near, std::move(first)}, {block.corner + step, far, std::move(second)}};
        }
    }
    return best;
}

std::size_t copies_in(const std::vector<Block>& blocks)
{
    std::size_t sum = 0;
    for (const Block& block : blocks) {
        sum += block.layout.size();
    }
    return sum;
}

std::vector<Block> better_split(const Splitter& splitter, const Block& block)
{
    std::vector<Block> upright = splitter.split(block, 0), lying = splitter.split(block, 1);
    return copies_in(lying) > copies_in(upright) ? lying : upright;
}

} // namespace

Layout best_blocks(const Piece& piece, const Room& room, std::size_t more_than)
{
    if (piece.patterns.empty()) {
        return {};
    }
    const Splitter splitter(piece, room);
    std::vector<Block> parts;
    for (const Block& half : better_split(splitter, {Vec2::Zero(), room, splitter.filled(room)})) {
        for (Block& part : better_split(splitter, half)) {
            parts.push_back(std::move(part));
        }
    }
    Layout layout;
    if (copies_in(parts) > more_than) {
        for (const Block& part : parts) {
            for (Placement placement : part.layout) {
                placement.offset += part.corner;
                layout.push_back(placement);
            }
        }
    }
    return layout;
}

} // namespace rhombloom::nesting
