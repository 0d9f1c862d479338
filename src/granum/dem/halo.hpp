// Where granules live: wrapping at periodic faces, migration to the rank that owns their place, copies near the faces.
//
// A copy holds the position of its owner to the last bit, over periodic faces too: the pair list knows the shift. So
// both ranks of a split pair compute the same contact.
#pragma once

#include "granum/dem/pair_list.hpp"
#include "granum/par/partition.hpp"
#include "granum/particle/attachment.hpp"

#include <span>

namespace granum::dem
{
//! A contact on its way to another rank, into a checkpoint or back.
struct ContactRecord
{
    static constexpr Id wall_bit = Id{1} << 63;

    Id low;           //!< id of the granule, or of the one with the lower id
    Id high;          //!< id of the partner, or wall_bit | wall << 8 | place
    History history;  //!< the first partner against the second
};

class Halo
{
  public:
    Halo(par::Partition partition, par::Communicator const& comm) : partition_(std::move(partition)), comm_(comm) {}

    par::Partition const& partition() const { return partition_; }
    void partition(par::Partition fresh) { partition_ = std::move(fresh); }
    int owner(Vec3 const& x) const { return partition_.owner(x); }

    //! Sends owned rows whose place belongs to another rank there, each with its `contacts` and what is attached, and
    //! takes those that come. `kept` receives the former rows of those that stayed, in their order; arrivals stand
    //! behind them. Returns the contacts that came. Collective.
    std::vector<ContactRecord> migrate(
        particle::Store& granules,
        std::function<std::vector<ContactRecord>(std::vector<std::uint32_t> const&)> const& contacts_of,
        std::span<particle::Attachment* const> attachments, std::vector<std::uint32_t>& kept) const;

    //! Appends copies of all granules of other ranks within `reach` (m) of this rank's part. Collective.
    void fill(Frame& frame, double reach);
    //! Copies position, velocity and spin from the owners: sends those of this rank now, and takes the others' when it
    //! ends. Collective.
    void begin_refresh(Frame const& frame);
    void end_refresh(Frame& frame);
    //! Copies all that a copy holds. Collective.
    void refresh_all(Frame& frame);

    //! Fills the copies' places behind the owned rows with what their owners have. Collective.
    void spread(std::vector<double>& of_rows) const;

  private:
    struct Side
    {
        int rank;
        std::vector<std::uint32_t> rows;   // what is sent
        std::size_t first = 0, count = 0;  // rows that arrive
        std::vector<double> out, in;       // buffers of a refresh
    };

    par::Partition partition_;
    par::Communicator comm_;
    std::vector<Side> sides_;
    std::vector<MPI_Request> requests_;
};
}
