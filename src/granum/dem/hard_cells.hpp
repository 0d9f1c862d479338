// Cells that tell which hard spheres can meet next: one nested grid per class of sizes.
//
// Sizes fall in classes of a factor two. The cells of a class are at least as wide as its largest diameter, and those
// of the next smaller class are theirs cut in eight. Two spheres can touch only if their cells on the grid of the
// larger one are neighbours, so a small sphere never looks at more large cells, and a large one at no more small ones,
// than volume demands. The index of a sphere's cell, not its position, says where it is: rounding cannot lose it.
// At sides that do not repeat, the outermost cells reach to infinity.
#pragma once

#include "granum/dem/hard_state.hpp"

namespace granum::dem
{
class HardCells
{
  public:
    //! The next face of its cell that a sphere passes.
    struct Exit
    {
        double time;     //!< s
        int axis, side;  //!< side -1 or +1; axis -1: none
    };

    //! Lays the grids over the spheres as they are at `time` and puts each in its cell. Spheres with less than `margin`
    //! (m) between their surfaces are neighbours.
    void build(HardState const& state, double time, double margin);

    //! When sphere i, whose row is at time t, leaves its cell.
    Exit exit(HardState const& state, std::size_t i) const;
    //! Moves sphere i to the next cell; a position that thereby passes a periodic side is moved by its width.
    void pass(HardState& state, std::size_t i, Exit const& through);

    //! Calls visit(j, shift) for every sphere j in a neighbouring cell; `shift` belongs to j's position to make it the
    //! image meant. i itself is left out.
    template <class Visit>
    void near(std::size_t i, Visit&& visit) const
    {
        for (int level = 0; level < levels_; ++level)
            if (filled_[static_cast<std::size_t>(level)] > 0) look(i, level, -1, 0, visit);
    }
    //! Only those that became neighbours when i passed `through`.
    template <class Visit>
    void newly_near(std::size_t i, Exit const& through, Visit&& visit) const
    {
        Place const& place = place_[i];
        auto const axis = static_cast<std::size_t>(through.axis);
        for (int level = 0; level < levels_; ++level) {
            if (filled_[static_cast<std::size_t>(level)] == 0) continue;
            int const up = level > place.level ? level - place.level : 0;
            // On a coarser grid only the passing of a coarse face brings new neighbours.
            int const first_inside = through.side > 0 ? 0 : (1 << up) - 1;
            if ((place.cell[axis] & ((1 << up) - 1)) != first_inside) continue;
            look(i, level, through.axis, through.side, visit);
        }
    }

  private:
    struct Place
    {
        std::array<int, 3> cell;
        int level;  // 0 the finest
    };

    std::size_t index(int level, std::array<int, 3> const& cell) const
    {
        auto const& n = count_[static_cast<std::size_t>(level)];
        return begin_[static_cast<std::size_t>(level)] +
               (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(n[1]) +
                static_cast<std::size_t>(cell[1])) *
                   static_cast<std::size_t>(n[0]) +
               static_cast<std::size_t>(cell[0]);
    }
    void insert(std::size_t i);
    void remove(std::size_t i);

    template <class Visit>
    void look(std::size_t i, int level, int axis, int side, Visit&& visit) const;
    template <class Visit>
    void list(std::size_t i, std::size_t cell, Vec3 const& shift, Visit&& visit) const
    {
        for (int j = head_[cell]; j >= 0; j = next_[static_cast<std::size_t>(j)])
            if (static_cast<std::size_t>(j) != i) visit(static_cast<std::size_t>(j), shift);
    }

    int levels_ = 0;
    std::vector<std::array<int, 3>> count_;  // cells of each level
    std::vector<Vec3> width_;
    std::vector<std::size_t> begin_;  // of each level in head_
    std::vector<long> filled_;        // spheres of each level
    Vec3 origin_, extent_;
    std::array<bool, 3> periodic_{};
    std::vector<int> head_, next_, previous_;
    std::vector<Place> place_;
};

template <class Visit>
void HardCells::look(std::size_t i, int level, int axis, int side, Visit&& visit) const
{
    Place const& place = place_[i];
    int const common = level > place.level ? level : place.level;  // the grid on which the two are neighbours
    auto const& n = count_[static_cast<std::size_t>(common)];
    int const down = common - level;
    std::array<int, 3> first{-1, -1, -1}, last{1, 1, 1};
    if (axis >= 0) first[static_cast<std::size_t>(axis)] = last[static_cast<std::size_t>(axis)] = side;
    std::array<std::array<int, 3>, 3> cells;  // by axis and offset: the index, wrapped; -1 outside
    std::array<std::array<double, 3>, 3> shifts;
    for (std::size_t d = 0; d < 3; ++d)
        for (int o = first[d]; o <= last[d]; ++o) {
            auto const slot = static_cast<std::size_t>(o + 1);
            int at = (place.cell[d] >> (common - place.level)) + o;
            double shift = 0;
            if (at < 0 || at >= n[d]) {
                shift = at < 0 ? -extent_[d] : extent_[d];
                at = !periodic_[d] ? -1 : at < 0 ? n[d] - 1 : 0;
            }
            cells[d][slot] = at;
            shifts[d][slot] = shift;
        }
    for (int oz = first[2]; oz <= last[2]; ++oz) {
        auto const z = static_cast<std::size_t>(oz + 1);
        if (cells[2][z] < 0) continue;
        for (int oy = first[1]; oy <= last[1]; ++oy) {
            auto const y = static_cast<std::size_t>(oy + 1);
            if (cells[1][y] < 0) continue;
            std::size_t const row = down == 0 ? index(level, {0, cells[1][y], cells[2][z]}) : 0;
            for (int ox = first[0]; ox <= last[0]; ++ox) {
                auto const x = static_cast<std::size_t>(ox + 1);
                if (cells[0][x] < 0) continue;
                Vec3 const shift{shifts[0][x], shifts[1][y], shifts[2][z]};
                std::array<int, 3> const cell{cells[0][x], cells[1][y], cells[2][z]};
                if (down == 0) {
                    list(i, row + static_cast<std::size_t>(cell[0]), shift, visit);
                    continue;
                }
                int const parts = 1 << down;
                for (int c = 0; c < parts; ++c)
                    for (int b = 0; b < parts; ++b)
                        for (int a = 0; a < parts; ++a)
                            list(i, index(level, {cell[0] * parts + a, cell[1] * parts + b, cell[2] * parts + c}),
                                 shift, visit);
            }
        }
    }
}
}
