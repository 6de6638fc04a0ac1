#include "host/scene/obj.h"

#include "host/scene/obj_lines.h"
#include "host/scene/obj_mesh.h"
#include "host/scene/obj_plain.h"
#include "host/scene/obj_statement.h"

// Compiled in here, in double: the library that distributions build rounds each number to float before the
// transform, and converts what is out of range. Rotations and large offsets would show that.
#define TINYOBJLOADER_IMPLEMENTATION
#ifndef TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_USE_DOUBLE
#endif
#include <tiny_obj_loader.h>

#include <istream>
#include <streambuf>

namespace hyalite {

namespace {

// Stands between the file and tinyobjloader, which knows no line numbers and trusts what it reads: hands on
// one checked statement at a time, so that in a callback the current line is the statement's. Statements in the
// plainest form, nearly all of a file, do not even get there.
class CheckedObjSource : public std::streambuf {
  public:
    CheckedObjSource(ObjLines &objLines, ObjMeshBuilder &meshBuilder, std::size_t &unusedCount,
                     const OnReading &listener)
        : lines(objLines), builder(meshBuilder), unusedStatementCount(unusedCount), onReading(listener) {}

  protected:
    int_type underflow() override {
        for (;;) {
            while (const char *nextBegin =
                       readPlainStatement(lines.peek(), lines.peekedLineNumber(), builder))
                lines.take(nextBegin);
            const std::optional<std::span<char>> line = lines.next();
            if (!line)
                return traits_type::eof();
            reportProgress();
            const CheckedStatement statement = checkStatement(*line, lines);
            if (statement.kind == ObjStatement::Geometry) {
                char *const begin = statement.text.data();
                setg(begin, begin, begin + statement.text.size());
                return traits_type::to_int_type(*begin);
            }
            unusedStatementCount += statement.kind == ObjStatement::Unused;
        }
    }

  private:
    static constexpr std::size_t stepBytes = std::size_t{1} << 22;

    void reportProgress() {
        if (!onReading || lines.bytesRead() < nextReportBytes)
            return;
        nextReportBytes = lines.bytesRead() + stepBytes;
        onReading(lines.shareRead());
    }

    ObjLines &lines;
    ObjMeshBuilder &builder;
    std::size_t &unusedStatementCount;
    const OnReading &onReading;
    std::size_t nextReportBytes = stepBytes;
};

struct CallbackData {
    const ObjLines &lines;
    ObjMeshBuilder &builder;
    std::vector<ObjCorner> corners{}; ///< of the current face
};

CallbackData &callbackData(void *userData) { return *static_cast<CallbackData *>(userData); }

tinyobj::callback_t makeCallbacks() {
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void *userData, double x, double y, double z, double) {
        const CallbackData &data = callbackData(userData);
        data.builder.addPosition({x, y, z}, data.lines.lineNumber());
    };
    callbacks.normal_cb = [](void *userData, double x, double y, double z) {
        callbackData(userData).builder.addNormal({x, y, z});
    };
    callbacks.index_cb = [](void *userData, tinyobj::index_t *indices, int count) {
        CallbackData &data = callbackData(userData);
        data.corners.clear();
        for (int i = 0; i < count; ++i)
            data.corners.push_back({indices[i].vertex_index, indices[i].normal_index});
        data.builder.addFace(data.corners, data.lines.lineNumber());
    };
    return callbacks;
}

} // namespace

ObjMesh loadObj(const std::filesystem::path &file, const MeshTransform &transform,
                const OnReading &onReading) {
    ObjLines lines(file);
    ObjMeshBuilder builder(lines.fileName(), transform);
    std::size_t unusedStatementCount = 0;
    CheckedObjSource source(lines, builder, unusedStatementCount, onReading);
    std::istream stream(&source);
    stream.exceptions(std::ios::badbit); // so that an Error of the source passes through the stream
    CallbackData data{lines, builder};
    tinyobj::LoadObjWithCallback(stream, makeCallbacks(), &data);
    ObjMesh loaded = builder.finish();
    loaded.report.unusedStatementCount = unusedStatementCount;
    return loaded;
}

} // namespace hyalite
