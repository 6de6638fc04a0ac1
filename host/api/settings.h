// Settings: what a render is asked for, by names.
//
// The names are those of the command line's options, with _ for -: "spp", "max_depth", "camera_position".
// settingNames() lists them, and `hyalite render --help` says what each does. They override what the scene says.
#pragma once

#include "hyalite/version.h"

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hyalite {

/// The value of a setting: a number, a word, several numbers (a point, a colour, a crop), or true and false.
class Value {
  public:
    Value(bool flag) : value_(flag) {}
    template <class Number>
    requires std::integral<Number> || std::floating_point<Number> Value(Number number)
        : value_(static_cast<double>(number)) {}
    Value(const char *text) : value_(std::string(text)) {}
    Value(std::string text) : value_(std::move(text)) {}
    Value(std::vector<double> numbers) : value_(std::move(numbers)) {}
    Value(std::initializer_list<double> numbers) : value_(std::vector<double>(numbers)) {}

    [[nodiscard]] const std::variant<bool, double, std::string, std::vector<double>> &get() const {
        return value_;
    }

  private:
    std::variant<bool, double, std::string, std::vector<double>> value_;
};

/// In the order in which they are given; of two of a name the later one counts. Names and values are checked when they
/// are used: an Error{Usage} names the setting, what was found and what is allowed.
class Settings {
  public:
    Settings() = default;
    Settings(std::initializer_list<std::pair<std::string, Value>> values) : values_(values) {}

    Settings &set(std::string name, Value value) {
        values_.emplace_back(std::move(name), std::move(value));
        return *this;
    }

    [[nodiscard]] const std::vector<std::pair<std::string, Value>> &values() const { return values_; }

  private:
    std::vector<std::pair<std::string, Value>> values_;
};

/// All names, in the order of help texts.
[[nodiscard]] HYALITE_API std::vector<std::string> settingNames();

} // namespace hyalite
