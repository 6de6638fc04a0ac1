// layout.h means the same bytes to the host and to a kernel: each struct, filled with distinct values, comes back field
// by field.
#include "tests/kernels/probe_device.h"
#include "tests/kernels/words.h"

#include "echoKernel.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>

namespace hyalite::core::testing {
namespace {

using layout::uint;
#include "layout_macros.h"

/// What the kernel is to write: the words of all fields as this compiler finds them, and their names.
struct Expected {
    Words words;
    std::vector<std::string> names;
    std::uint32_t structCount = 0;

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
#define EXPECT_FIELDS(Struct, record)                                                                        \
    do {                                                                                                     \
        const std::size_t before = expected.words.get().size();                                              \
        FIELDS_##Struct(ADD_FIELD, record)                                                                   \
                EXPECT_EQ((expected.words.get().size() - before) * 4, sizeof(layout::Struct))                \
            << #Struct;                                                                                      \
        ++expected.structCount;                                                                              \
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
    const Pair<layout::SkipNode> skip(Storage);
    const Pair<layout::EmitterRecord> emitter(Storage);
    const Pair<layout::LookupRow> texel(Storage);
    const Pair<layout::TextureRow> textureRow(Storage);
    const Pair<layout::TextureRecord> texture(Storage);
    const Pair<layout::InstanceRecord> instance(Storage);
    const Pair<layout::LightNode> lightNode(Storage);
    const Pair<layout::TrianglePair> trianglePair(Storage);
    const Pair<layout::SampleRecord> sample(Storage);
    const Pair<layout::PlaceRecord> place(Storage);
    const Pair<layout::WideNode> wide(Storage);
    const layout::DispatchConstants dispatch = fill<layout::DispatchConstants>();

    Expected expected;
    EXPECT_FIELDS(FrameRecord, frame.records[1]);
    EXPECT_FIELDS(SphereRecord, sphere.records[1]);
    EXPECT_FIELDS(LightRecord, light.records[1]);
    EXPECT_FIELDS(MaterialRecord, material.records[1]);
    EXPECT_FIELDS(NodePair, node.records[1]);
    EXPECT_FIELDS(TriangleRecord, triangle.records[1]);
    EXPECT_FIELDS(NormalRecord, normal.records[1]);
    EXPECT_FIELDS(FilmPixel, film.records[1]);
    EXPECT_FIELDS(DispatchProgress, progress.records[1]);
    EXPECT_FIELDS(TraceEvent, trace.records[1]);
    EXPECT_FIELDS(PathRecord, path.records[1]);
    EXPECT_FIELDS(PendingRay, pending.records[1]);
    EXPECT_FIELDS(SkipNode, skip.records[1]);
    EXPECT_FIELDS(EmitterRecord, emitter.records[1]);
    EXPECT_FIELDS(LookupRow, texel.records[1]);
    EXPECT_FIELDS(TextureRow, textureRow.records[1]);
    EXPECT_FIELDS(TextureRecord, texture.records[1]);
    EXPECT_FIELDS(InstanceRecord, instance.records[1]);
    EXPECT_FIELDS(LightNode, lightNode.records[1]);
    EXPECT_FIELDS(TrianglePair, trianglePair.records[1]);
    EXPECT_FIELDS(SampleRecord, sample.records[1]);
    EXPECT_FIELDS(PlaceRecord, place.records[1]);
    EXPECT_FIELDS(WideNode, wide.records[1]);
    EXPECT_FIELDS(DispatchConstants, dispatch);
    EXPECT_EQ(expected.structCount, layoutStructCount) << "a struct of layout.h is not echoed";

    std::vector<std::uint32_t> words(expected.words.get().size());
    const gpu::Buffer output(probeDevice(), "the words", Storage, std::span(words).size_bytes());
    const std::array<const gpu::Buffer *, 24> buffers{
        &frame.buffer,    &sphere.buffer,   &light.buffer,     &material.buffer,
        &node.buffer,     &triangle.buffer, &normal.buffer,    &film.buffer,
        &progress.buffer, &trace.buffer,    &path.buffer,      &pending.buffer,
        &skip.buffer,     &emitter.buffer,  &texel.buffer,     &textureRow.buffer,
        &texture.buffer,  &instance.buffer, &lightNode.buffer, &trianglePair.buffer,
        &sample.buffer,   &place.buffer,    &wide.buffer,      &output};
    gpu::Kernel(probeDevice(), "echo", echoKernel, {}, buffers).run(dispatch, 1);
    output.download(std::as_writable_bytes(std::span(words)));
    for (std::size_t i = 0; i < words.size(); ++i)
        EXPECT_EQ(words[i], expected.words.get()[i].bits) << expected.names[i] << ", word " << i;
}

} // namespace
} // namespace hyalite::core::testing
