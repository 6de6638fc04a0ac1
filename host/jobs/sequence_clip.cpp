#include "host/jobs/sequence_clip.h"

#include "host/film/film_file.h"

#include <fmt/format.h>

namespace hyalite::core {

namespace {

/// Frames that follow each other.
std::string rangeText(const std::vector<int> &frames) {
    return frames.size() == 1 ? fmt::format("{}", frames.front())
                              : fmt::format("{}..{}", frames.front(), frames.back());
}

} // namespace

SequenceClip::SequenceClip(const std::filesystem::path &path, double framesPerSecond)
    : file_(path), framesPerSecond_(framesPerSecond),
      writer_(makeClipWriter(file_, clipFormatOf(path).value(), framesPerSecond)) {}

void SequenceClip::add(int frame, const Drawing &picture) {
    isWhole_ = false;
    writer_->add(picture.width, picture.height, picture.rgb);
    isWhole_ = true;
    frames_.push_back(frame);
}

void SequenceClip::write(const std::vector<int> &wanted, const RenderSession &session,
                         const std::string &commandLine) {
    std::vector<Attribute> attributes = attributesOfSeveral(session, commandLine);
    const std::string ofWanted = frames_ == wanted ? "" : " of " + rangeText(wanted);
    attributes.emplace_back("frames", rangeText(frames_) + ofWanted);
    attributes.emplace_back("framesPerSecond", fmt::format("{}", framesPerSecond_));
    attributes.emplace_back(pixelsAttribute, writer_->pixelHash());
    writer_->finish(attributes);
    file_.commit();
}

} // namespace hyalite::core
