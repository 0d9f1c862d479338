#include "granum/par/communicator.hpp"

namespace granum::par
{
namespace
{
template <class T>
T reduce(MPI_Comm comm, T value, MPI_Datatype type, MPI_Op op)
{
    T out = value;
    MPI_Allreduce(&value, &out, 1, type, op, comm);
    return out;
}
}

Communicator::Communicator(MPI_Comm handle) : handle_(handle)
{
    MPI_Comm_rank(handle_, &rank_);
    MPI_Comm_size(handle_, &size_);
}

double Communicator::sum(double value) const
{
    return reduce(handle_, value, MPI_DOUBLE, MPI_SUM);
}
long Communicator::sum(long value) const
{
    return reduce(handle_, value, MPI_LONG, MPI_SUM);
}
double Communicator::max(double value) const
{
    return reduce(handle_, value, MPI_DOUBLE, MPI_MAX);
}
double Communicator::min(double value) const
{
    return reduce(handle_, value, MPI_DOUBLE, MPI_MIN);
}
long Communicator::max(long value) const
{
    return reduce(handle_, value, MPI_LONG, MPI_MAX);
}

void Communicator::sum(std::span<double> values) const
{
    if (size_ > 1)
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, handle_);
}

void Communicator::barrier() const
{
    MPI_Barrier(handle_);
}

std::vector<std::byte> Communicator::exchange(std::span<std::byte const> out, int to, int from) const
{
    int const to_rank = to < 0 ? MPI_PROC_NULL : to;
    int const from_rank = from < 0 ? MPI_PROC_NULL : from;
    long const mine = static_cast<long>(out.size());
    long theirs = 0;
    MPI_Sendrecv(&mine, 1, MPI_LONG, to_rank, 1, &theirs, 1, MPI_LONG, from_rank, 1, handle_, MPI_STATUS_IGNORE);
    std::vector<std::byte> in(static_cast<std::size_t>(theirs));
    MPI_Sendrecv(out.data(), static_cast<int>(mine), MPI_BYTE, to_rank, 2, in.data(), static_cast<int>(theirs),
                 MPI_BYTE, from_rank, 2, handle_, MPI_STATUS_IGNORE);
    return in;
}

std::vector<std::byte> Communicator::gather(std::span<std::byte const> mine) const
{
    int const count = static_cast<int>(mine.size());
    std::vector<int> counts(root() ? static_cast<std::size_t>(size_) : 0), starts(counts.size());
    MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, handle_);
    int total = 0;
    for (std::size_t r = 0; r < counts.size(); ++r) {
        starts[r] = total;
        total += counts[r];
    }
    std::vector<std::byte> all(static_cast<std::size_t>(total));
    MPI_Gatherv(mine.data(), count, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, 0, handle_);
    return all;
}

void Communicator::broadcast(std::vector<std::byte>& bytes) const
{
    long size = static_cast<long>(bytes.size());
    MPI_Bcast(&size, 1, MPI_LONG, 0, handle_);
    bytes.resize(static_cast<std::size_t>(size));
    MPI_Bcast(bytes.data(), static_cast<int>(size), MPI_BYTE, 0, handle_);
}
}
