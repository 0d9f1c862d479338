// Forces and torques of all contacts of a rank, in one pass over the candidate list.
#pragma once

#include "granum/dem/contact_laws.hpp"
#include "granum/dem/contact_store.hpp"
#include "granum/geometry/wall.hpp"

#include <string>

namespace granum::dem
{
//! Overlaps over the radius of the smaller partner: above the first a step counts as warned, above the second it fails.
struct OverlapLimits
{
    double warn = 0.10, stop = 0.50;
};

//! What a pass saw on this rank. Of a pair split over two ranks (or with a periodic image) each side counts one half of
//! the energies.
struct SweepResult
{
    double largest_overlap = 0;  //!< over the radius of the smaller partner
    long contacts = 0;
    double dissipated = 0;  //!< J, in this step
    double elastic = 0;     //!< J, stored in the contacts
    Vec3 wall_force;        //!< of the walls on owned granules, N
    std::string failure;    //!< which contact is beyond the stopping limit; empty if none
};

class ContactSweep
{
  public:
    //! Computes what each pair of materials needs once.
    ContactSweep(Laws const& laws, std::vector<geometry::Wall> const& walls, OverlapLimits const& limits);

    //! Adds the contact forces and torques to the columns of the store and moves histories on by dt (s; 0 leaves them).
    SweepResult operator()(particle::Store& granules, ContactStore& contacts, double dt) const;

  private:
    template <class Normal, class Tangential, class Rolling>
    void pairs(Normal const&, Tangential const&, Rolling const&, particle::Store&, ContactStore&, double dt,
               SweepResult&) const;
    template <class Normal, class Tangential, class Rolling>
    void walls(Normal const&, Tangential const&, Rolling const&, particle::Store&, ContactStore&, double dt,
               SweepResult&) const;

    Laws laws_;
    std::vector<geometry::Wall> walls_;
    OverlapLimits limits_;
    std::size_t materials_;
    std::vector<law::contact::Pair<double>> table_;  // [a * materials_ + b]
};
}
