#include "host/import/ies.h"

#include "host/base/content_guess.h"
#include "host/base/letter_case.h"
#include "host/import/obj_lines.h"
#include "host/scene/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace hyalite::core {

namespace {

constexpr std::size_t maxFileBytes = std::size_t{1} << 28; ///< more than the largest profile as text

/// Lines, and then numbers, wherever their lines end.
class Scanner {
  public:
    Scanner(std::string_view text, std::string fileName) : text_(text), fileName_(std::move(fileName)) {}

    /// The next line without blanks around it. Empty at the end of the file.
    std::optional<std::string_view> line() {
        if (at_ >= text_.size())
            return std::nullopt;
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        std::string_view line = text_.substr(at_, end - at_);
        at_ = end;
        skipLineEnd();
        while (!line.empty() && isBlank(line.front()))
            line.remove_prefix(1);
        while (!line.empty() && isBlank(line.back()))
            line.remove_suffix(1);
        return line;
    }

    double number(std::string_view what, const Interval &allowed) {
        const std::string_view word = nextWord(what);
        const double value = parsed(word, what);
        if (!allowed.contains(allowed.rounded(value)))
            fail(fmt::format("{}: found {}; allowed: {}", what, quoteInput(word), allowed.text()));
        return allowed.rounded(value);
    }

    double number(std::string_view what) {
        const std::string_view word = nextWord(what);
        return parsed(word, what);
    }

    std::size_t whole(std::string_view what, std::size_t low, std::size_t high) {
        const double value = number(what, Interval{static_cast<double>(low), static_cast<double>(high)});
        if (value != std::floor(value))
            fail(fmt::format("{}: found {}; allowed: whole numbers", what, value));
        return static_cast<std::size_t>(value);
    }

    void skip(std::string_view what, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            static_cast<void>(number(what));
    }

    /// Bytes that are left: twice the numbers that they can hold, and one more.
    [[nodiscard]] std::size_t bytesLeft() const { return text_.size() - at_; }

    [[nodiscard]] bool hasMore() {
        skipBlanks();
        return at_ < text_.size();
    }

    /// At the number that came last.
    [[noreturn]] void fail(std::string_view message) const { failAtLine(fileName_, wordLine_, message); }

    [[nodiscard]] const std::string &fileName() const { return fileName_; }

  private:
    static bool isBlank(char c) { return static_cast<unsigned char>(c) <= ' '; }
    static bool isDelimiter(char c) { return isBlank(c) || c == ','; }

    void skipLineEnd() {
        if (at_ >= text_.size() || (text_[at_] != '\r' && text_[at_] != '\n'))
            return;
        at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
        wordLine_ = ++line_;
    }

    void skipBlanks() {
        while (at_ < text_.size() && isDelimiter(text_[at_]))
            if (text_[at_] == '\r' || text_[at_] == '\n')
                skipLineEnd();
            else
                ++at_;
    }

    std::string_view nextWord(std::string_view what) {
        skipBlanks();
        wordLine_ = line_;
        if (at_ >= text_.size())
            fail(fmt::format("the file ends before its {}: it is cut short, or its counts are wrong", what));
        std::size_t end = at_;
        while (end < text_.size() && !isDelimiter(text_[end]))
            ++end;
        const std::string_view word = text_.substr(at_, end - at_);
        at_ = end;
        return word;
    }

    [[nodiscard]] double parsed(std::string_view word, std::string_view what) const {
        const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
        double value = 0.0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
            fail(fmt::format("{}: found {}; allowed: a finite number", what, quoteInput(word)));
        return value;
    }

    std::string_view text_;
    std::string fileName_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
    std::size_t wordLine_ = 1; ///< of the word that came last
};

/// Numbers of a file that matter, as they stand in it.
struct Photometry {
    double factor = 1.0; ///< of all candela
    std::vector<double> gammas;
    std::vector<double> planes;
    std::vector<double> candela; ///< plane by plane
};

/// Reads up to the line of TILT, and its factors. Returns whether the ballast has two factors: the files of 1986 and 1991
/// have one for the lamp with it, which later ones keep free, or have a code in.
bool readHead(Scanner &scanner, const InputFile &file, std::vector<std::string> &warnings) {
    bool isOld = true;
    for (bool isFirst = true;; isFirst = false) {
        const std::optional<std::string_view> line = scanner.line();
        if (!line)
            throw file.bad(foreignContent(file, "it has no line TILT=, and is no IES file (IESNA LM-63)"));
        const std::string small = lowerCase(*line);
        if (isFirst)
            isOld = !small.starts_with("iesna:lm-63-") && !small.starts_with("ies:lm-63-");
        if (!small.starts_with("tilt"))
            continue;
        const std::size_t equals = small.find_first_not_of(" \t", 4);
        if (equals == std::string::npos || small[equals] != '=')
            continue;
        const std::size_t value = std::min(small.find_first_not_of(" \t", equals + 1), small.size());
        const std::string tilt = small.substr(value);
        if (tilt == "none")
            return isOld;
        warnings.push_back(fmt::format("{}: TILT: passed over: light counts as that of a lamp that is "
                                       "not tilted",
                                       scanner.fileName()));
        if (tilt == "include") {
            scanner.skip("geometry of TILT", 1);
            const std::size_t count = scanner.whole("number of angles of TILT", 1, 65536);
            scanner.skip("angles of TILT", count);
            scanner.skip("factors of TILT", count);
        }
        return isOld;
    }
}

void requireTypeC(Scanner &scanner) {
    constexpr std::array<std::string_view, 3> names{"C", "B", "A"};
    const std::size_t type = scanner.whole("photometric type", 1, 3);
    if (type != 1)
        scanner.fail(
            fmt::format("photometric type: found {}, type {}; allowed: 1, type C", type, names[type - 1]));
}

std::vector<double> readAngles(Scanner &scanner, std::string_view what, std::size_t count,
                               const Interval &allowed) {
    std::vector<double> angles;
    angles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        angles.push_back(scanner.number(what, allowed));
        if (i > 0 && !(angles[i] > angles[i - 1]))
            scanner.fail(fmt::format("{}: found {} after {}; allowed: angles that ascend", what, angles[i],
                                     angles[i - 1]));
    }
    return angles;
}

Photometry readNumbers(Scanner &scanner, bool isOld, std::vector<std::string> &warnings) {
    const Interval positive{0.0, limits::candela.high, false};
    Photometry read;
    scanner.skip("number and lumens of lamps", 2);
    read.factor = scanner.number("candela multiplier", positive);
    const std::size_t gammaCount = scanner.whole("number of vertical angles", 2, limits::profileAngleCount);
    const std::size_t planeCount = scanner.whole("number of horizontal angles", 1, limits::profileAngleCount);
    requireTypeC(scanner);
    scanner.skip("units and size", 4);
    read.factor *= scanner.number("ballast factor", positive);
    const double lampFactor = scanner.number("factor of the lamp with its ballast");
    scanner.skip("input watts", 1);
    if (isOld && lampFactor > 0.0)
        read.factor *= lampFactor;
    const std::size_t count = gammaCount * planeCount;
    if (count > scanner.bytesLeft() / 2 + 1)
        scanner.fail(fmt::format("found {} x {} candela values, more than the rest of the file holds: it is "
                                 "cut short, or its counts are wrong",
                                 planeCount, gammaCount));
    read.gammas = readAngles(scanner, "vertical angle", gammaCount, limits::profileAngle);
    read.planes = readAngles(scanner, "horizontal angle", planeCount, {0.0, 360.0});
    read.candela.reserve(count);
    std::size_t negativeCount = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double value = scanner.number("candela value", {-limits::candela.high, limits::candela.high});
        negativeCount += value < 0.0 ? 1 : 0;
        read.candela.push_back(std::max(value, 0.0));
    }
    if (negativeCount > 0)
        warnings.push_back(fmt::format("{}: {} of {} candela values are negative, and count as 0",
                                       scanner.fileName(), negativeCount, count));
    if (scanner.hasMore())
        warnings.push_back(
            fmt::format("{}: passed over: what follows its {} candela values", scanner.fileName(), count));
    return read;
}

/// A plane around the lamp: a mixture of two planes of the file.
struct Plane {
    double angle;
    std::size_t first;
    std::size_t second;
    double share = 0.0; ///< of the second one
};

/// Appends the mirror images of planes, whose last angle is about `angle`.
void mirror(std::vector<Plane> &planes, double angle) {
    for (std::size_t i = planes.size(); i-- > 0;)
        if (planes[i].angle < angle)
            planes.push_back(
                {2.0 * angle - planes[i].angle, planes[i].first, planes[i].second, planes[i].share});
}

/// Planes from 90 to 270 degrees, in the halves that mirror each other, from 0 on.
std::vector<Plane> turnedHalves(const std::vector<double> &angles) {
    std::size_t next = 0; // the first that is not before 180 degrees
    while (angles[next] < 180.0)
        ++next;
    const Plane middle =
        angles[next] == 180.0
            ? Plane{180.0, next, next}
            : Plane{180.0, next - 1, next, (180.0 - angles[next - 1]) / (angles[next] - angles[next - 1])};
    std::vector<Plane> planes{{0.0, middle.first, middle.second, middle.share}};
    for (std::size_t i = next; i-- > 1;)
        planes.push_back({180.0 - angles[i], i, i});
    for (std::size_t i = 0; i < angles.size(); ++i) {
        if (i == next && angles[i] != 180.0)
            planes.push_back(middle);
        planes.push_back({angles[i], i, i});
    }
    for (std::size_t i = angles.size() - 1; i-- > 0 && angles[i] > 180.0;)
        planes.push_back({540.0 - angles[i], i, i});
    planes.push_back({360.0, middle.first, middle.second, middle.share});
    return planes;
}

/// The planes all around, by the symmetry of those of the file.
std::vector<Plane> allAround(const Scanner &scanner, std::vector<double> angles) {
    constexpr double tolerance = 0.01; // degrees
    if (angles.size() == 1)
        return {{0.0, 0, 0}};
    const auto snap = [](double &angle, double to) {
        const bool isThere = std::abs(angle - to) <= tolerance;
        angle = isThere ? to : angle;
        return isThere;
    };
    double &first = angles.front();
    double &last = angles.back();
    if (snap(first, 90.0) && snap(last, 270.0)) {
        for (double &angle : angles)
            snap(angle, 180.0);
        return turnedHalves(angles);
    }
    const double found = last;
    const bool isQuarter = snap(last, 90.0);
    const bool isHalf = snap(last, 180.0);
    if (!snap(first, 0.0) || (last < 180.0 && !isQuarter))
        scanner.fail(
            fmt::format("horizontal angles: found those from {} to {}; allowed: 0, 0 to 90, 0 to 180, "
                        "0 to 360, 90 to 270",
                        first, found));
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < angles.size(); ++i)
        planes.push_back({angles[i], i, i});
    if (isQuarter)
        mirror(planes, 90.0);
    if (isQuarter || isHalf)
        mirror(planes, 180.0);
    else if (!snap(planes.back().angle, 360.0))
        planes.push_back({360.0, 0, 0}); // the files of many programs do without it
    return planes;
}

} // namespace

IesFile readIes(const InputFile &file) {
    if (file.sizeBytes() > maxFileBytes)
        throw file.bad(fmt::format("has {} bytes; at most {} are read", file.sizeBytes(), maxFileBytes));
    std::vector<char> text(static_cast<std::size_t>(file.sizeBytes()));
    file.read(0, std::as_writable_bytes(std::span(text)));
    const std::size_t begin = byteOrderMarkBytes(text);
    Scanner scanner({text.data() + begin, text.size() - begin}, file.path().string());
    IesFile read;
    const bool isOld = readHead(scanner, file, read.warnings);
    const Photometry numbers = readNumbers(scanner, isOld, read.warnings);

    const std::size_t gammaCount = numbers.gammas.size();
    const double greatest = *std::ranges::max_element(numbers.candela);
    LightProfile &profile = read.profile;
    profile.name = scanner.fileName();
    profile.candela = greatest * numbers.factor;
    if (!(greatest > 0.0) || !limits::candela.contains(profile.candela))
        scanner.fail(fmt::format("found {} candela at most; allowed: more than 0, at most {}",
                                 profile.candela, limits::candela.high));
    profile.gammas = numbers.gammas;
    const std::vector<Plane> planes = allAround(scanner, numbers.planes);
    if (planes.size() * gammaCount > limits::profileValueCount)
        scanner.fail(fmt::format("found {} x {} candela values all around; allowed: at most {} in all",
                                 planes.size(), gammaCount, limits::profileValueCount));
    profile.shares.reserve(planes.size() * gammaCount);
    for (const Plane &plane : planes) {
        profile.planes.push_back(plane.angle);
        for (std::size_t i = 0; i < gammaCount; ++i) {
            const double first = numbers.candela[plane.first * gammaCount + i];
            const double second = numbers.candela[plane.second * gammaCount + i];
            profile.shares.push_back(static_cast<float>((first + (second - first) * plane.share) / greatest));
        }
    }
    return read;
}

} // namespace hyalite::core
