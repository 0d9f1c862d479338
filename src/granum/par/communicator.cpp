#include "granum/par/communicator.hpp"

#include <algorithm>

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

template <class T>
void share_all(MPI_Comm comm, std::span<T const> mine, std::span<T> all, std::span<int const> counts, MPI_Datatype type)
{
    std::vector<int> starts(counts.size());
    for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
    MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), type, all.data(), counts.data(), starts.data(), type,
                   comm);
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

void Communicator::max(std::span<double> values) const
{
    if (size_ > 1)
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, handle_);
}

void Communicator::sum(std::span<double> values) const
{
    if (size_ > 1)
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, handle_);
}

void Communicator::sum(std::span<base::ExactSum> values) const
{
    static_assert(sizeof(base::ExactSum) == base::ExactSum::size * sizeof(std::int64_t));
    if (size_ > 1)
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size() * base::ExactSum::size), MPI_INT64_T,
                      MPI_SUM, handle_);
}

bool Communicator::meet(double seconds) const
{
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(handle_, &request);
    int here = 0;
    for (double const end = MPI_Wtime() + seconds; here == 0 && MPI_Wtime() < end;)
        MPI_Test(&request, &here, MPI_STATUS_IGNORE);
    return here != 0;
}

void Communicator::barrier() const
{
    MPI_Barrier(handle_);
}

std::string Communicator::first_said(std::string const& mine) const
{
    long const speaker = -max(mine.empty() ? -static_cast<long>(size_) : -static_cast<long>(rank_));
    if (speaker == size_) return "";
    auto const bytes = std::as_bytes(std::span(mine));
    auto said = gather(rank_ == speaker ? bytes : bytes.first(0));
    broadcast(said);
    return {reinterpret_cast<char const*>(said.data()), said.size()};
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

std::vector<MPI_Request> Communicator::begin(std::span<Message const> messages) const
{
    constexpr int tag = 3;
    std::vector<MPI_Request> pending;
    for (auto const& message : messages)
        if (!message.in.empty())
            MPI_Irecv(message.in.data(), static_cast<int>(message.in.size()), MPI_DOUBLE, message.rank, tag, handle_,
                      &pending.emplace_back());
    for (auto const& message : messages)
        if (!message.out.empty())
            MPI_Isend(message.out.data(), static_cast<int>(message.out.size()), MPI_DOUBLE, message.rank, tag, handle_,
                      &pending.emplace_back());
    return pending;
}

void Communicator::end(std::vector<MPI_Request> pending) const
{
    MPI_Waitall(static_cast<int>(pending.size()), pending.data(), MPI_STATUSES_IGNORE);
}

std::vector<std::vector<std::byte>> Communicator::deliver(std::vector<std::vector<std::byte>> const& to_each) const
{
    auto const ranks = static_cast<std::size_t>(size_);
    std::vector<long> sent(ranks), expected(ranks);
    for (std::size_t r = 0; r < ranks; ++r) sent[r] = static_cast<long>(to_each[r].size());
    MPI_Alltoall(sent.data(), 1, MPI_LONG, expected.data(), 1, MPI_LONG, handle_);
    std::vector<std::vector<std::byte>> from_each(ranks);
    std::vector<MPI_Request> requests;
    constexpr long most = 1L << 30;  // bytes in one message
    for (std::size_t r = 0; r < ranks; ++r) {
        from_each[r].resize(static_cast<std::size_t>(expected[r]));
        for (long at = 0; at < expected[r]; at += most)
            MPI_Irecv(from_each[r].data() + at, static_cast<int>(std::min(most, expected[r] - at)), MPI_BYTE,
                      static_cast<int>(r), 7, handle_, &requests.emplace_back());
    }
    for (std::size_t r = 0; r < ranks; ++r)
        for (long at = 0; at < sent[r]; at += most)
            MPI_Isend(to_each[r].data() + at, static_cast<int>(std::min(most, sent[r] - at)), MPI_BYTE,
                      static_cast<int>(r), 7, handle_, &requests.emplace_back());
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return from_each;
}

void Communicator::share(std::span<float const> mine, std::span<float> all, std::span<int const> counts) const
{
    share_all(handle_, mine, all, counts, MPI_FLOAT);
}
void Communicator::share(std::span<double const> mine, std::span<double> all, std::span<int const> counts) const
{
    share_all(handle_, mine, all, counts, MPI_DOUBLE);
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
