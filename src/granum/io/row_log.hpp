// Rows of numbers on the disk as they come, which can be cut back to any earlier number of rows and then checked.
#pragma once

#include "granum/io/hash.hpp"

#include <cstdio>
#include <functional>
#include <string>

namespace granum::io
{
class RowLog
{
  public:
    //! Rows of `width` numbers in the file `path`; call `begin` or `go_on` before anything else.
    RowLog(std::string path, std::size_t width) : path_(std::move(path)), width_(width) {}
    ~RowLog();
    RowLog(RowLog const&) = delete;
    RowLog& operator=(RowLog const&) = delete;

    //! What a checkpoint remembers of the log.
    struct Mark
    {
        std::uint64_t rows = 0, hash = 0;
    };

    //! Starts the file anew. Throws base::IoError, here and below, naming the file.
    void begin();
    //! Cuts the file back to `mark` and hands every row kept to `visit`. Throws where the rows are not those marked.
    void go_on(Mark const& mark, std::function<void(std::span<double const>)> const& visit);
    //! @param rows any number of whole rows, row after row
    void append(std::span<double const> rows);
    //! Brings all to the disk.
    Mark mark() const;

  private:
    [[noreturn]] void fail(char const* what) const;

    std::string path_;
    std::size_t width_;
    std::FILE* file_ = nullptr;
    std::uint64_t rows_ = 0;
    Hash hash_;
};
}
