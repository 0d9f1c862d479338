// The granules of a rank as the kernels want them, beside the store: what a contact asks for in one row of memory.
#pragma once

#include "granum/base/aligned.hpp"
#include "granum/dem/contact_laws.hpp"
#include "granum/dem/kernel/kernel.hpp"
#include "granum/particle/store.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace granum::dem
{
using math::Vec3;
using particle::Id;

//! The box that granules live in.
struct Domain
{
    Vec3 lower, upper;  //!< m
    std::array<bool, 3> periodic{};

    Vec3 size() const { return upper - lower; }
    kernel::Images images() const;
};

//! Rows as in the store: owned granules, then those that others own. Two rows more, behind the last, meet nobody.
struct Frame
{
    base::AlignedVector<kernel::Body> bodies;
    std::vector<std::uint8_t> material;
    std::vector<Id> id;
    std::vector<kernel::Collisions> collisions;  //!< of each row since give(); empty where the store does not want them
    std::size_t owned = 0;
    double unit_force = 1;  //!< force at an overlap of a thousandth of the radius over the radius^unit_power
    int unit_power = 2;

    std::size_t rows() const { return id.size(); }
    kernel::Collisions* counted() { return collisions.empty() ? nullptr : collisions.data(); }
    std::uint32_t lonely() const { return static_cast<std::uint32_t>(rows()); }

    //! Takes rows [0, owned) as the store has them, with their forces and torques. Drops what lies behind.
    void take(particle::Store const& granules);
    //! Takes motion, radius and mass of owned rows, which stay where they are.
    void refresh(particle::Store const& granules);
    //! Gives motion, forces, torques and collisions of owned rows to the store.
    void give(particle::Store& granules);
    //! Makes room for rows behind the owned ones, up to `rows` in all, and closes the end.
    void resize(std::size_t rows);

    //! Brings a row that left a periodic domain through one side back through the other.
    void wrap(Domain const& domain, std::size_t row);

    static Vec3 vec(double const* from) { return {from[0], from[1], from[2]}; }
    Vec3 position(std::size_t row) const { return vec(bodies[row].position); }
    double radius(std::size_t row) const { return bodies[row].radius; }
    //! How far it may go before the list is made anew, m; 0 before the first.
    double room(std::size_t row) const
    {
        double const per = bodies[row].per_room2;
        return per > 0 ? 1 / std::sqrt(per) : 0;
    }

    //! Finds the unit of force from the stiffest pairing of the laws.
    void scale_to(Laws const& laws);
};
}
