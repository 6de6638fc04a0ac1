// Values of PLY files, one after the other: as text, and as bytes of either order. Both kinds have the same members, so
// that what reads elements is written once.
#pragma once

#include "host/base/error.h"
#include "host/import/mesh_builder.h"
#include "host/import/ply_header.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hyalite::core {

/// The file ends before its values do.
class PlyCutShort : public Error {
  public:
    using Error::Error;
};

/// Values as text: one row of an element a line. Errors name lines.
class PlyTextValues {
  public:
    static constexpr PlaceUnit unit = PlaceUnit::Line;

    /// `body` begins at line `line`. `fileName` outlives this.
    PlyTextValues(std::span<const char> body, std::size_t line, const std::string &fileName)
        : begin_(body.data()), at_(body.data()), end_(body.data() + body.size()), line_(line),
          fileName_(fileName) {}

    /// The fewest bytes of a row: a digit and a blank for each property.
    [[nodiscard]] static std::size_t minRowBytes(const PlyElement &element) {
        return 2 * element.properties.size();
    }

    /// Begins a row of `element`, on the next line that is not empty. Throws PlyCutShort at the end of the file.
    void beginRow(const PlyElement &element);
    /// The next value of the row. Throws Error{BadInput} for a value that is no number, and at the end of the line.
    [[nodiscard]] double next(PlyType type);
    void skip(PlyType type, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            static_cast<void>(next(type));
    }
    /// Ends a row: the rest of the line is passed over. Returns whether it has more values.
    bool endRow();

    [[nodiscard]] std::size_t place() const { return line_; }
    [[nodiscard]] std::size_t bytesRead() const { return static_cast<std::size_t>(at_ - begin_); }
    [[nodiscard]] std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - at_); }
    [[noreturn]] void fail(std::string_view message) const { failAtPlace(fileName_, unit, line_, message); }

  private:
    const char *begin_;
    const char *at_;
    const char *end_;
    std::size_t line_;
    const std::string &fileName_;
    const PlyElement *element_ = nullptr; ///< of the row
};

/// Values as bytes. Errors name offsets from the beginning of the file.
class PlyByteValues {
  public:
    static constexpr PlaceUnit unit = PlaceUnit::Byte;

    /// `body` begins at byte `offset` of the file. `fileName` outlives this.
    PlyByteValues(std::span<const char> body, std::size_t offset, bool isSwapped, const std::string &fileName)
        : begin_(body.data()), at_(body.data()), end_(body.data() + body.size()), offset_(offset),
          isSwapped_(isSwapped), fileName_(fileName) {}

    [[nodiscard]] static std::size_t minRowBytes(const PlyElement &element) {
        std::size_t bytes = 0;
        for (const PlyProperty &property : element.properties)
            bytes += sizeOf(property.isList ? property.countType : property.type);
        return bytes;
    }

    void beginRow(const PlyElement &element) {
        element_ = &element;
        row_ = at_;
    }
    /// Throws PlyCutShort at the end of the file, as skip() does.
    [[nodiscard]] double next(PlyType type);
    void skip(PlyType type, std::size_t count) {
        if (bytesLeft() / sizeOf(type) < count)
            failCut();
        at_ += sizeOf(type) * count;
    }
    static bool endRow() { return false; }

    [[nodiscard]] std::size_t place() const { return offset_ + static_cast<std::size_t>(row_ - begin_); }
    [[nodiscard]] std::size_t bytesRead() const { return static_cast<std::size_t>(at_ - begin_); }
    [[nodiscard]] std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - at_); }
    [[noreturn]] void fail(std::string_view message) const { failAtPlace(fileName_, unit, place(), message); }

  private:
    [[noreturn]] void failCut() const;
    template <class T> [[nodiscard]] T load();

    const char *begin_;
    const char *at_;
    const char *end_;
    std::size_t offset_;
    bool isSwapped_;
    const std::string &fileName_;
    const PlyElement *element_ = nullptr; ///< of the row
    const char *row_ = begin_;            ///< where it begins
};

} // namespace hyalite::core
