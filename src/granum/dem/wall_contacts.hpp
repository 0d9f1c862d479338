// The granules that may touch wall bodies, with the history of those that do, and where the bodies are.
//
// A granule has up to geometry::most_touches contacts with a body. A history belongs to (granule, body, direction of
// the contact) and goes on with the contact whose direction is nearest, so that a granule that passes from one triangle
// of a body to the next keeps it. Loads on bodies are summed without rounding: they have the same bits on any number of
// ranks.
#pragma once

#include "granum/base/exact_sum.hpp"
#include "granum/dem/pair_list.hpp"
#include "granum/geometry/body_search.hpp"
#include "granum/par/communicator.hpp"

namespace granum::dem
{
//! What granules do to a body.
struct WallLoad
{
    Vec3 force;   //!< N
    Vec3 torque;  //!< about the body's origin where it is now, N m
    bool operator==(WallLoad const&) const = default;
};

class WallContacts
{
  public:
    //! The bodies stand where they are at time 0. Of several servos of a body the first counts.
    WallContacts(std::vector<geometry::Body> const& bodies, Domain const& domain);

    //! Number of columns of the histories.
    void shape(std::size_t columns) { columns_ = columns; }
    //! Forgets all contacts. Bodies stay where they are.
    void clear();

    //! Puts the bodies where they are at `time` (s), the servos after a step of `dt` (s; 0: no step).
    void go_to(double time, double dt);
    //! The farthest that a point of a body within the domain has moved since the list was made, m. The same on all
    //! ranks.
    double moved() const;

    //! Lists the owned granules that come to touch a body when they use up their room (Frame::room) and it moves by
    //! `room` (m); `farthest` is the largest radius with its room of all ranks (m). `row_now` and `lost` as in
    //! PairList::make.
    void make(Frame const& frame, Layers const& layers, double room, double farthest,
              std::function<std::uint32_t(std::uint32_t)> const& row_now, kernel::Rules const& rules,
              kernel::Energy& lost);

    //! Finds the contacts of the granules of some units of the layers where they are now and adds their forces.
    void run(Layers::Range const& units, kernel::Kernel const& kernel, kernel::Rules const& rules, Frame& frame,
             double dt, kernel::Seen& seen);
    //! To be called when all layers have run: counts the work of moving bodies and lets servos answer. Collective where
    //! a body has a servo.
    void finish(kernel::Rules const& rules, Frame const& frame, double dt, par::Communicator const& comm);
    //! Whether a body moves: then all layers must be run at the same time.
    bool any_motion() const { return any_motion_; }

    //! Calls what(row, partner, history) for every contact.
    template <class What>
    void for_each_touching(What&& what) const
    {
        for (std::size_t k = 0; k < size_; ++k)
            if (touches(k)) what(row(k), partner(k), history(k));
    }

    //! Calls what(row, body, distance of the centre in m) where a body is beside a granule without touching it, closer
    //! to its surface than `gap` (m), which the list must reach.
    void for_each_beside(Frame const& frame, double gap,
                         std::function<void(std::uint32_t, std::uint32_t, double)> const& what) const;

    Vec3 force() const;  //!< of all bodies on this rank's granules at the last run, N
    //! Loads on all bodies at the last run, over all ranks. Collective.
    std::vector<WallLoad> loads(Frame const& frame, par::Communicator const& comm) const;
    //! Work of moving walls on this rank's granules in the last step, J.
    kernel::Energy const& work() const { return work_; }

    //! One state per body; without meaning for bodies without a servo.
    std::vector<geometry::ServoState> servos() const;
    void servos(std::vector<geometry::ServoState> const& states);
    geometry::Pose const& pose(std::size_t body) const { return bodies_[body].pose; }
    std::uint32_t material(std::size_t body) const { return bodies_[body].material; }

    //! Places of the list; those that touch hold a contact.
    std::size_t size() const { return size_; }
    bool touches(std::size_t k) const { return (touching_[k / kernel::block] >> (k % kernel::block) & 1) != 0; }
    std::uint32_t row(std::size_t k) const { return kernel::row_of(granules_[k]); }
    std::uint32_t body(std::size_t k) const { return body_[k]; }
    double overlap(std::size_t k) const { return overlap_[k]; }  //!< m
    Vec3 normal(std::size_t k) const { return get(normal_, k); }
    Vec3 velocity(std::size_t k) const { return get(velocity_, k); }  //!< of the surface at the contact, m/s
    History history(std::size_t k) const;

    //! The partner of a contact in a record, ContactRecord::high without its wall bit: body << 40 | direction.
    Id partner(std::size_t k) const;
    static std::uint32_t body_of(Id partner) { return static_cast<std::uint32_t>(partner >> 40); }
    //! Gives a contact its history back, if the granule is listed with the body.
    void set(std::uint32_t row, Id partner, History const& history);

  private:
    using Numbers = base::AlignedVector<double>;
    using Triples = std::array<Numbers, 3>;

    struct Moving
    {
        geometry::BodySearch search;
        std::vector<geometry::Motion> motions;
        std::size_t in_place = 0;
        std::optional<geometry::Plane> plane{};  // where that and nothing else is the body, at rest
        std::optional<geometry::Servo> servo{};
        geometry::ServoState state{};
        geometry::Bounds box{};  // as drawn; infinite where the body is
        Vec3 origin;
        std::uint32_t material = 0;
        geometry::Pose pose{}, built{};  // now, and when the list was made
        double reach = 0;                // of the list, m
    };

    //! Contacts that a granule may have with a body: places [place, place + places), facets [facet, next entry's).
    struct Near
    {
        std::uint32_t row, body, place, places;
        std::size_t facet;
    };

    void measure(Layers::Range const& units, kernel::Rules const& rules, Frame const& frame, kernel::Energy& lost);
    void place_touches(Near const& near, double radius, std::span<geometry::Nearest const> touches,
                       kernel::Rules const& rules, kernel::Energy& lost);
    void end(std::size_t place, kernel::Rules const& rules, kernel::Energy& lost);
    using ExactLoad = std::array<base::ExactSum, 7>;  // force, torque, mass of the granules that touch a servo
    std::vector<ExactLoad> tally(Frame const& frame, par::Communicator const& comm, bool servos_only) const;
    void add_work(kernel::Rules const& rules, Frame const& frame, double dt);
    void look_around(Vec3 const& x, double reach, std::uint32_t body);
    Near const* find(std::uint32_t row, std::uint32_t body) const;
    double& history_at(std::size_t k, std::size_t column)
    {
        return history_[(k / kernel::block * columns_ + column) * kernel::block + k % kernel::block];
    }
    static Vec3 get(Triples const& from, std::size_t k) { return {from[0][k], from[1][k], from[2][k]}; }
    static void put(Triples& to, std::size_t k, Vec3 const& what)
    {
        to[0][k] = what.x, to[1][k] = what.y, to[2][k] = what.z;
    }

    std::vector<Moving> bodies_;
    Domain domain_;
    double time_ = 0;
    bool any_servo_ = false, any_motion_ = false;
    std::size_t columns_ = 6, size_ = 0;
    std::vector<Near> near_;                                   // by unit, row and body
    std::vector<std::size_t> near_begin_{0}, block_begin_{0};  // of the units
    Layers const* layers_ = nullptr;
    std::vector<std::uint32_t> facets_;
    std::vector<std::uint32_t> granules_, body_;  // per place
    std::vector<std::uint8_t> material_, touching_;
    Numbers history_, overlap_;
    Triples normal_, velocity_, spin_, force_, torque_;
    geometry::BodySearch::Scratch scratch_;
    kernel::Energy work_;
};

//! A direction in 40 bits, and back: to 5e-6 rad. Coding what was decoded gives the same code.
std::uint64_t code_of(Vec3 const& direction);
Vec3 direction_of(std::uint64_t code);
}
