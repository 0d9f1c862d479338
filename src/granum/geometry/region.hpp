// Regions: the space that gas and granules may fill, as an expression of solids.
//
//     Region open = Region("column", cylinder(...)) | Region("dome", Ball{...});
//     open = open - Region("nozzle", tube(...));
//
// The inside of every solid is a region of its own. a | b is what is open in one of them, a & b what is open in both,
// a - b what is open in a and not in b. Solids that are joined by | may touch or overlap: there is no wall between
// them.
#pragma once

#include "granum/geometry/solid.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace granum::geometry
{
//! How far the wall is and which solid bounds there.
struct WallDistance
{
    double distance;    //!< m, above 0 where it is open; at most the true distance in magnitude
    Vec3 normal;        //!< unit, the direction in which `distance` grows fastest: towards the open
    std::size_t solid;  //!< number in the region's list
};

class Region
{
  public:
    //! The inside of a solid. Throws base::CaseError for what is no solid.
    Region(std::string name, Solid solid);
    //! The inside of a chamber. Where nothing else is near, cells and faces are cut by the chamber's exact formulas, as
    //! long as nothing is joined to it by |.
    Region(std::string name, Chamber chamber);

    friend Region operator|(Region a, Region b);
    friend Region operator&(Region a, Region b);
    friend Region operator-(Region a, Region b);
    //! What is closed becomes open.
    friend Region operator~(Region a);

    //! Where the wall is farther than `enough` (m), a lower distance above that and any normal may be given, if that is
    //! faster.
    WallDistance at(Vec3 const& x, double enough = std::numeric_limits<double>::infinity()) const;
    double distance(Vec3 const& x) const { return at(x).distance; }
    Vec3 normal(Vec3 const& x) const { return at(x).normal; }
    //! Whether a place is open; within a seam of joined solids it is.
    bool open(Vec3 const& x) const;
    std::size_t nearest_solid(Vec3 const& x) const { return at(x).solid; }

    //! Whether the straight line from a to b, its ends included, leaves the open region. Sees walls of any thickness
    //! down to 1e-9 of the region's size. Where it runs within a seam of joined solids, or beside a wall for more than
    //! ten thousand steps, it sees walls down to 2e-4 of the line's length. An end that lies on a wall is not in it.
    bool blocked(Vec3 const& a, Vec3 const& b) const;

    //! Corners of a box around the open region; infinite where it has no bounds.
    Vec3 lower() const { return bounds_.lower; }
    Vec3 upper() const { return bounds_.upper; }
    double size() const { return size_; }  //!< the diagonal of that box or, without bounds, 1 m

    std::size_t solids() const { return leaves_.size(); }
    std::string const& name(std::size_t solid) const { return leaves_[solid].name; }
    Solid const& solid(std::size_t number) const { return leaves_[number].solid; }
    //! Whether granules and gas are in the solid, or around it.
    bool open_inside(std::size_t solid) const { return leaves_[solid].open_inside; }

    //! Whether the region is open only where the solid leaves it open, whatever the others do.
    bool bounds_everywhere(std::size_t solid) const;
    //! The region as if some solids that bound everywhere were not there; nothing if no other is left. Numbers stay.
    std::optional<Region> without(std::vector<std::size_t> const& some) const;

    //! The chamber, if it is all that bounds within `reach` (m) of x; else nothing.
    Chamber const* only_chamber(Vec3 const& x, double reach) const;

  private:
    struct Leaf
    {
        std::string name;
        Solid solid;
        Bounds box;
        bool open_inside;
    };
    struct Node
    {
        bool all;                         // open where all its parts are; else where one is
        std::vector<std::int32_t> parts;  // nodes; leaf k is -1 - k
    };

    static Region join(Region a, Region b, bool all);
    void turn_inside_out();
    WallDistance leaf_at(std::size_t leaf, Vec3 const& x, double enough) const;
    WallDistance node_at(std::size_t node, Vec3 const& x, double enough, std::int32_t without) const;
    Bounds bounds_of(std::int32_t part) const;
    void measure();

    std::vector<Leaf> leaves_;
    std::vector<Node> nodes_;  // the last is the root
    Bounds bounds_;
    double size_ = 1;
    std::optional<Chamber> chamber_;  // of leaf 0, which is a part of the root
};

//! A place in the open near the middle of the box [low, high]: the middle, moved by some hundredths of the box so that
//! no symmetry puts it into a wall's middle, or else the open place next to it. Nothing where the box is closed.
std::optional<Vec3> open_place(Region const& region, Vec3 const& low, Vec3 const& high);
}
