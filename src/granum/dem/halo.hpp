// Where granules live: wrapping at periodic faces, migration to the rank that owns their slab, ghosts near the faces.
//
// Ghosts come in three rounds: from the neighbours along x, then images across periodic y, then across periodic z, each
// round copying what the ones before brought, so that edges and corners are covered.
#pragma once

#include "granum/dem/contact_store.hpp"
#include "granum/par/communicator.hpp"
#include "granum/par/slabs.hpp"
#include "granum/particle/attachment.hpp"

#include <array>
#include <span>

namespace granum::dem
{
//! The periodic box that granules live in.
struct Domain
{
    Vec3 lower, upper;  //!< m
    std::array<bool, 3> periodic{};
};

class Halo
{
  public:
    Halo(Domain const& domain, par::Slabs const& slabs, par::Communicator const& comm);

    //! Throws NumericsError where the domain is too narrow for ghosts within `reach` of granules of `largest_radius`,
    //! m.
    void check_width(double largest_radius, double reach) const;

    //! Brings owned granules back into the periodic domain and sends those that left the slab to their rank, with all
    //! that belongs to them. Drops all ghosts. Collective.
    void settle(particle::Store& granules, SavedContacts& contacts,
                std::span<particle::Attachment* const> attachments) const;

    //! True if an owned granule lies outside the slab or the periodic domain. Local.
    bool strayed(particle::Store const& granules) const;

    //! Appends ghosts within `reach` of the faces. Collective.
    void fill(particle::Store& granules, double reach);

    //! Copies position, velocity and spin from the owners to the ghosts. Collective.
    void refresh_motion(particle::Store& granules);

    //! Copies every column that ghosts carry. Collective.
    void refresh_all(particle::Store& granules) const;

  private:
    struct Side
    {
        int to = -1, from = -1;            // ranks
        Vec3 shift;                        // of what arrives
        std::vector<std::uint32_t> rows;   // what is sent
        std::size_t first = 0, count = 0;  // ghost rows that arrive
        std::vector<double> out, in;       // buffers of refresh_motion
    };
    struct Image
    {
        std::uint32_t row;
        Vec3 shift;
    };

    void add_images(particle::Store& granules, std::size_t direction, double reach);

    Domain domain_;
    par::Slabs slabs_;
    par::Communicator comm_;
    std::array<Side, 2> sides_;  // sent to the left, sent to the right
    std::vector<Image> images_;
    std::size_t first_image_ = 0;
};
}
