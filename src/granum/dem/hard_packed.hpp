// Hard spheres in short time steps, for packings: where collisions would come without end, steps go on.
//
// In a step every sphere is accelerated, then the pairs and walls that would be passed through within the step are
// given impulses, in rounds, until none is: first a bounce as in flight, and then, where it still presses, a push
// without rebound that lets the gap just close. The displacements that follow are put right by moving spheres apart,
// and where that is not enough the displacement of a sphere is cut at its first collision. So spheres come to rest,
// carry weight, and never overlap; what is lost is the order of collisions within a step. The scheme is our own, in the
// manner of contact dynamics; its time step is one in which nobody moves by more than a twentieth of the smallest
// radius.
#pragma once

#include "granum/dem/hard_cells.hpp"
#include "granum/dem/hard_world.hpp"

namespace granum::dem
{
class HardPacked
{
  public:
    explicit HardPacked(HardWorld& world) : world_(world) {}

    //! Goes from `now`, where all rows must be, towards `until` by at most `steps` steps, which are counted off.
    //! Returns the time reached; all rows are then at that time.
    double advance(double now, double until, int& steps);

  private:
    struct Contact
    {
        std::uint32_t first, second;  // second: a row, or wall_first + number of the wall
        Vec3 n;                       // from the first to the second
        double gap;                   // m
        bool bounced;
    };
    static constexpr std::uint32_t wall_first = 0x80000000u;

    double step_length(double left) const;
    void list_neighbours(double now);
    void find_contacts(double reach);
    void exchange_impulses(double step);
    bool push_apart(Contact& contact, double step, double slow, double done);
    void displace(double step, double reach);
    void separate();
    void hold_back();

    HardWorld& world_;
    HardCells cells_;
    double skin_ = 0, moved_ = 0;  // of the neighbour list, m; what it has lost of it
    std::vector<std::array<std::uint32_t, 2>> near_;
    std::vector<Contact> contacts_;
    std::vector<Vec3> before_;  // velocities at the beginning of the step
    std::vector<Vec3> displacement_;
    std::vector<std::uint8_t> touched_;
    std::vector<double> share_;  // of the displacement that is made
};
}
