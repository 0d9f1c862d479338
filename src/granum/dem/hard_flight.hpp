// Hard spheres from collision to collision: the event-driven way, exact under constant acceleration.
//
// Every sphere has one next event: the collision it expects first, or leaving its cell. A collision that a sphere
// expects remembers how many collisions its partner had had; if that number has changed when the time comes, the
// partner was hit by another, and the sphere looks again. So a collision costs two looks at the neighbourhood and a few
// moves in the heap, O(log n). Source: Lubachevsky, J. Comput. Phys. 94 (1991) 255 (recalled, unverified).
#pragma once

#include "granum/dem/event_queue.hpp"
#include "granum/dem/hard_cells.hpp"
#include "granum/dem/hard_world.hpp"

namespace granum::dem
{
class HardFlight
{
  public:
    explicit HardFlight(HardWorld& world) : world_(world) {}

    //! Lays the cells and predicts everybody's next event from `now` on. Where spheres have accelerations of their own,
    //! events are looked for up to `horizon` only, when these change. Throws NumericsError where spheres overlap.
    void start(double now, double horizon);

    //! Handles the events up to `until`. Returns the time reached: `until`, or earlier where the collisions of a sphere
    //! follow each other so fast that there is no getting on; all rows are then at that time.
    double advance(double now, double until);

    //! Collisions counted from a moment on, by which `advance` sees that there is no getting on.
    struct Pace
    {
        long collisions = 0;
        double since = 0;  //!< s
    };
    Pace pace;

  private:
    struct Next
    {
        double time;            // s
        std::uint32_t partner;  // row, or wall_first + number of the wall
        std::uint32_t hits;     // of the partner when this was predicted
    };
    static constexpr std::uint32_t wall_first = 0x80000000u, nobody = 0xFFFFFFFFu;

    struct Lookout;
    struct Straight;
    struct Bent;

    void predict(std::size_t i, double now);
    void predict_walls(std::size_t i, double now, Next& best) const;
    void settle(std::size_t i, Next const& best);
    void leave(std::size_t i, double now);
    void look_for_exit(std::size_t i, double now);
    void collide(std::size_t i, std::size_t j, double now);
    void collide_wall(std::size_t i, std::size_t wall, double now);
    void queue(std::size_t i) { queue_.move(static_cast<std::uint32_t>(i), std::min(next_[i].time, exit_[i].time)); }

    HardWorld& world_;
    HardCells cells_;
    EventQueue queue_;
    std::vector<Next> next_;
    std::vector<HardCells::Exit> exit_;
    std::vector<std::uint32_t> hits_;
    double horizon_ = 0;
};
}
