// Output file that an option may request.
#pragma once

#include "host/base/atomic_file.h"

#include <optional>
#include <string>
#include <string_view>

namespace hyalite::core {

class RequestedFile {
  public:
    /// Opens it before the work begins, so that one that cannot be written is known now. Empty: not requested. Throws as
    /// AtomicFile does.
    explicit RequestedFile(const std::string &path) {
        if (!path.empty())
            file_.emplace(path);
    }

    explicit operator bool() const { return file_.has_value(); }

    /// The file, which was requested.
    [[nodiscard]] AtomicFile &operator*() { return *file_; }

    /// All of the file, at most once.
    void store(std::string_view text) {
        file_->write(text);
        file_->commit();
    }

  private:
    std::optional<AtomicFile> file_;
};

} // namespace hyalite::core
