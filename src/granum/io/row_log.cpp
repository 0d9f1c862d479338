#include "granum/io/row_log.hpp"

#include "granum/base/error.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

namespace granum::io
{
RowLog::~RowLog()
{
    if (file_) std::fclose(file_);
}

void RowLog::fail(char const* what) const
{
    throw base::IoError(fmt::format("{}: {}: {}", path_, what, std::strerror(errno)));
}

void RowLog::begin()
{
    file_ = std::fopen(path_.c_str(), "wb");
    if (!file_) fail("cannot be written");
}

void RowLog::go_on(Mark const& mark, std::function<void(std::span<double const>)> const& visit)
{
    file_ = std::fopen(path_.c_str(), "r+b");
    if (!file_ && mark.rows == 0) return begin();
    if (!file_) fail("cannot be opened");
    std::vector<double> row(width_);
    for (; rows_ < mark.rows; ++rows_) {
        if (std::fread(row.data(), sizeof(double), width_, file_) != width_)
            throw base::IoError(fmt::format("{}: ends at row {}, but {} rows were written", path_, rows_, mark.rows));
        hash_.add(std::as_bytes(std::span(row)));
        visit(row);
    }
    if (mark.rows > 0 && hash_.digest() != mark.hash)
        throw base::IoError(fmt::format("{}: its first {} rows are not those that were written", path_, mark.rows));
    auto const size = static_cast<off_t>(mark.rows * width_ * sizeof(double));
    if (ftruncate(fileno(file_), size) != 0) fail("cannot be cut back");
    if (fseeko(file_, size, SEEK_SET) != 0) fail("cannot be cut back");
}

void RowLog::append(std::span<double const> rows)
{
    if (rows.empty()) return;
    if (std::fwrite(rows.data(), sizeof(double), rows.size(), file_) != rows.size() || std::fflush(file_) != 0)
        fail("cannot be written");
    hash_.add(std::as_bytes(rows));
    rows_ += rows.size() / width_;
}

RowLog::Mark RowLog::mark() const
{
    if (std::fflush(file_) != 0 || fsync(fileno(file_)) != 0) fail("cannot be brought to the disk");
    return {rows_, hash_.digest()};
}
}
