// The ranks of a run and what they say to each other.
#pragma once

#include "granum/base/exact_sum.hpp"

#include <mpi.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace granum::par
{
//! Numbers that go to a rank and those that come from it. Both sides know the lengths.
struct Message
{
    int rank;
    std::span<double const> out;
    std::span<double> in;
};

//! Thin view of an MPI communicator. MPI is initialised by the program, never here.
class Communicator
{
  public:
    explicit Communicator(MPI_Comm handle = MPI_COMM_WORLD);

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool root() const { return rank_ == 0; }
    MPI_Comm handle() const { return handle_; }

    double sum(double value) const;
    long sum(long value) const;
    double max(double value) const;
    double min(double value) const;
    long max(long value) const;
    void sum(std::span<double> values) const;          //!< element by element, result on every rank
    void max(std::span<double> values) const;          //!< element by element, result on every rank
    void sum(std::span<base::ExactSum> values) const;  //!< the same, without rounding
    void barrier() const;

    //! True where all ranks come here within `seconds`: a barrier for when some may have failed and never come.
    bool meet(double seconds) const;

    //! What the lowest rank that has something to say says, on every rank; empty where none has. Collective.
    std::string first_said(std::string const& mine) const;

    //! Sends `out` to rank `to` while receiving from rank `from`; either may be -1 for nobody. Any length.
    std::vector<std::byte> exchange(std::span<std::byte const> out, int to, int from) const;

    //! @{ Sends and receives messages of numbers, and waits until all are there; what lies between may be other work.
    std::vector<MPI_Request> begin(std::span<Message const> messages) const;
    void end(std::vector<MPI_Request> pending) const;
    //! @}

    //! Sends to_each[r] to rank r and returns what each rank sent here. Collective.
    std::vector<std::vector<std::byte>> deliver(std::vector<std::vector<std::byte>> const& to_each) const;

    //! @{ The numbers of every rank one after the other, on every rank: `counts` of them by rank.
    void share(std::span<float const> mine, std::span<float> all, std::span<int const> counts) const;
    void share(std::span<double const> mine, std::span<double> all, std::span<int const> counts) const;
    //! @}

    //! The bytes of every rank one after the other, on rank 0 (empty elsewhere).
    std::vector<std::byte> gather(std::span<std::byte const> mine) const;

    //! The bytes of rank 0 on every rank.
    void broadcast(std::vector<std::byte>& bytes) const;

  private:
    MPI_Comm handle_;
    int rank_ = 0, size_ = 1;
};
}
