// layout.h means the same bytes to the host and to a kernel: each struct, filled with distinct values, comes back field
// by field.
#include "echoKernel.h"
#include "tests/kernels/layout_fields.h"
#include "tests/kernels/probe_device.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>

namespace hyalite::testing {
namespace {

/// What the kernel is to write: the words of all fields as this compiler finds them, and their names.
struct Expected {
    Words words;
    std::vector<std::string> names;

    template <class Field> void add(const char *name, const Field &field) {
        words << field;
        names.resize(words.get().size(), name);
    }
};

/// Normal floats, no two alike in the whole test.
std::uint32_t nextWord() {
    static std::uint32_t word = 0x3F800000u;
    return ++word;
}

template <class Record> Record fill() {
    std::array<std::uint32_t, sizeof(Record) / 4> words;
    for (std::uint32_t &word : words)
        word = nextWord();
    Record record;
    std::memcpy(&record, words.data(), sizeof(record));
    return record;
}

/// Two elements, of which the kernel reads the second.
template <class Record> struct Pair {
    std::array<Record, 2> records{fill<Record>(), fill<Record>()};
    gpu::Buffer buffer;

    explicit Pair(gpu::BufferUse use) : buffer(probeDevice(), "a pair of records", use, sizeof(records)) {
        buffer.upload(std::as_bytes(std::span(records)));
    }
};

// Adds the fields of `record`, and expects them to be all that it has.
#define EXPECT_FIELDS(FIELDS, record)                                                                        \
    do {                                                                                                     \
        const std::size_t before = expected.words.get().size();                                              \
        FIELDS(ADD_FIELD, record)                                                                            \
        EXPECT_EQ((expected.words.get().size() - before) * 4, sizeof(record)) << #FIELDS;                    \
    } while (false)
#define ADD_FIELD(field) expected.add(#field, field);

TEST(Layout, MeansTheSameBytesToHostAndKernel) {
    using enum gpu::BufferUse;
    const Pair<layout::FrameRecord> frame(Uniform);
    const Pair<layout::SphereRecord> sphere(Uniform);
    const Pair<layout::LightRecord> light(Uniform);
    const Pair<layout::MaterialRecord> material(Storage);
    const Pair<layout::NodePair> node(Storage);
    const Pair<layout::TriangleRecord> triangle(Storage);
    const Pair<layout::NormalRecord> normal(Storage);
    const Pair<layout::FilmPixel> film(Storage);
    const Pair<layout::DispatchProgress> progress(Storage);
    const Pair<layout::TraceEvent> trace(Storage);
    const Pair<layout::PathRecord> path(Storage);
    const Pair<layout::PendingRay> pending(Storage);
    const layout::DispatchConstants dispatch = fill<layout::DispatchConstants>();

    Expected expected;
    EXPECT_FIELDS(FRAME_FIELDS, frame.records[1]);
    EXPECT_FIELDS(SPHERE_FIELDS, sphere.records[1]);
    EXPECT_FIELDS(LIGHT_FIELDS, light.records[1]);
    EXPECT_FIELDS(MATERIAL_FIELDS, material.records[1]);
    EXPECT_FIELDS(NODE_FIELDS, node.records[1]);
    EXPECT_FIELDS(TRIANGLE_FIELDS, triangle.records[1]);
    EXPECT_FIELDS(NORMAL_FIELDS, normal.records[1]);
    EXPECT_FIELDS(FILM_FIELDS, film.records[1]);
    EXPECT_FIELDS(PROGRESS_FIELDS, progress.records[1]);
    EXPECT_FIELDS(TRACE_FIELDS, trace.records[1]);
    EXPECT_FIELDS(PATH_FIELDS, path.records[1]);
    EXPECT_FIELDS(PENDING_FIELDS, pending.records[1]);
    EXPECT_FIELDS(DISPATCH_FIELDS, dispatch);

    std::vector<std::uint32_t> words(expected.words.get().size());
    const gpu::Buffer output(probeDevice(), "the words", Storage, std::span(words).size_bytes());
    const std::array<const gpu::Buffer *, 13> buffers{
        &frame.buffer,    &sphere.buffer,  &light.buffer, &material.buffer, &node.buffer,
        &triangle.buffer, &normal.buffer,  &film.buffer,  &progress.buffer, &trace.buffer,
        &path.buffer,     &pending.buffer, &output};
    gpu::Kernel(probeDevice(), "echo", echoKernel, {}, buffers).run(dispatch, 1);
    output.download(std::as_writable_bytes(std::span(words)));
    for (std::size_t i = 0; i < words.size(); ++i)
        EXPECT_EQ(words[i], expected.words.get()[i].bits) << expected.names[i] << ", word " << i;
}

} // namespace
} // namespace hyalite::testing
