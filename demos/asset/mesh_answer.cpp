#include "demos/asset/mesh_answer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr std::uint8_t kError = 'e', kParts = 'p', kRefused = 'r';  // of the last: the system's number

/// Takes the answer apart; nothing where it is no answer.
class AnswerReader {
 public:
  explicit AnswerReader(std::span<const std::uint8_t> rest) : rest_(rest) {}

  std::optional<ImportedMesh> mesh() {
    ImportedMesh mesh;
    const std::optional<std::size_t> parts = count();
    if (!parts || *parts > kMostMeshParts) return std::nullopt;
    for (std::size_t i = 0; i < *parts; ++i) {
      MeshPart part;
      std::vector<Vec3> places;
      if (!points<ReadPart::Place>(part.vertices) || !points<ReadPart::Point>(part.normals) ||
          !points<ReadPart::Point>(part.colors) || !points<ReadPart::Point>(places))
        return std::nullopt;
      const std::size_t vertices = part.vertices.size();
      if (!part.normals.empty() && part.normals.size() != vertices) return std::nullopt;
      if (!part.colors.empty() && part.colors.size() != vertices) return std::nullopt;
      if (!places.empty() && places.size() != vertices) return std::nullopt;
      for (const Vec3& place : places) part.uv.push_back(place.head<2>());
      const std::optional<std::size_t> triangles = count();
      if (!triangles || *triangles > rest_.size() / sizeof(ReadPart::Corners)) return std::nullopt;
      for (std::size_t k = 0; k < *triangles; ++k) {
        ReadPart::Corners c;
        take(&c, sizeof c);
        if (std::max({c[0], c[1], c[2]}) >= vertices) return std::nullopt;
        part.triangles.push_back({static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2])});
      }
      std::int32_t picture = -1;
      if (rest_.size() < sizeof picture) return std::nullopt;
      take(&picture, sizeof picture);
      if (picture >= 0 && !part.uv.empty()) part.picture_of.assign(part.triangles.size(), picture);
      mesh.parts.push_back(std::move(part));
    }
    if (!pictures(mesh) || !notes(mesh) || !rest_.empty()) return std::nullopt;
    return mesh;
  }

 private:
  template <typename Written>
  bool points(std::vector<Vec3>& into) {
    const std::optional<std::size_t> number = count();
    if (!number || *number > rest_.size() / sizeof(Written)) return false;
    for (std::size_t k = 0; k < *number; ++k) {
      Written p;
      take(&p, sizeof p);
      into.emplace_back(p[0], p[1], p[2]);
      if (!into.back().allFinite()) return false;
    }
    return true;
  }
  bool pictures(ImportedMesh& mesh) {
    const std::optional<std::size_t> number = count();
    if (!number || *number > rest_.size()) return false;
    for (std::size_t k = 0; k < *number; ++k) {
      SurfacePicture picture;
      if (rest_.size() < 2 * sizeof(int)) return false;
      take(&picture.width, sizeof picture.width);
      take(&picture.height, sizeof picture.height);
      const std::optional<std::size_t> bytes = count();
      if (!bytes || *bytes > rest_.size() || picture.width < 1 || picture.height < 1 ||
          *bytes != 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height))
        return false;
      picture.rgb.resize(*bytes);
      take(picture.rgb.data(), *bytes);
      mesh.pictures.push_back(std::move(picture));
    }
    for (const MeshPart& part : mesh.parts)
      for (const int picture : part.picture_of)
        if (picture >= static_cast<int>(mesh.pictures.size())) return false;
    return true;
  }
  bool notes(ImportedMesh& mesh) {
    const std::optional<std::size_t> number = count();
    if (!number || *number > rest_.size()) return false;
    for (std::size_t k = 0; k < *number; ++k) {
      const std::optional<std::size_t> length = count();
      if (!length || *length > rest_.size()) return false;
      std::string note(*length, ' ');
      take(note.data(), *length);
      mesh.notes.push_back(std::move(note));
    }
    return true;
  }
  std::optional<std::size_t> count() {
    std::size_t value = 0;
    if (rest_.size() < sizeof value) return std::nullopt;
    take(&value, sizeof value);
    return value;
  }
  void take(void* to, std::size_t size) {
    std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }

  std::span<const std::uint8_t> rest_;
};

}  // namespace

ReadPart joinedPart(const ReadPart& part, const std::vector<unsigned>& named) {
  const auto isLess = [&part](unsigned a, unsigned b) {
    if (part.vertices[a] != part.vertices[b]) return part.vertices[a] < part.vertices[b];
    for (const auto* list : {&part.normals, &part.colors, &part.uv})
      if (!list->empty() && (*list)[a] != (*list)[b]) return (*list)[a] < (*list)[b];
    return false;
  };
  std::vector<unsigned> sorted = named, first(part.vertices.size()), number(part.vertices.size());
  std::vector<std::uint32_t> place(part.vertices.size(), 0);
  for (std::uint32_t i = 0; i < named.size(); ++i) place[named[i]] = i;
  std::sort(sorted.begin(), sorted.end(), [&](unsigned a, unsigned b) {
    if (isLess(a, b) || isLess(b, a)) return isLess(a, b);
    return place[a] < place[b];
  });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool is_alike = i > 0 && !isLess(sorted[i - 1], sorted[i]);
    first[sorted[i]] = is_alike ? first[sorted[i - 1]] : sorted[i];
  }
  ReadPart joined;
  joined.picture = part.picture;
  for (const unsigned vertex : named) {
    number[vertex] =
        first[vertex] == vertex ? static_cast<unsigned>(joined.vertices.size()) : number[first[vertex]];
    if (first[vertex] != vertex) continue;
    joined.vertices.push_back(part.vertices[vertex]);
    if (!part.normals.empty()) joined.normals.push_back(part.normals[vertex]);
    if (!part.colors.empty()) joined.colors.push_back(part.colors[vertex]);
    if (!part.uv.empty()) joined.uv.push_back(part.uv[vertex]);
  }
  for (const ReadPart::Corners& c : part.triangles)
    joined.triangles.push_back({number[c[0]], number[c[1]], number[c[2]]});
  return joined;
}

std::vector<std::uint8_t> answerBytes(const ReadMeshes& read) {
  std::vector<std::uint8_t> bytes(1, kParts);
  const auto put = [&bytes](const void* from, std::size_t count) {
    const std::size_t before = bytes.size();
    bytes.resize(before + count);
    if (count > 0) std::memcpy(bytes.data() + before, from, count);
  };
  const auto putList = [&put](const auto& list) {
    const std::size_t count = list.size();
    put(&count, sizeof count);
    put(list.data(), count * sizeof list[0]);
  };
  const std::size_t count = read.parts.size();
  put(&count, sizeof count);
  for (const ReadPart& part : read.parts) {
    putList(part.vertices);
    putList(part.normals);
    putList(part.colors);
    putList(part.uv);
    putList(part.triangles);
    put(&part.picture, sizeof part.picture);
  }
  const std::size_t pictures = read.pictures.size(), notes = read.notes.size();
  put(&pictures, sizeof pictures);
  for (const SurfacePicture& picture : read.pictures) {
    put(&picture.width, sizeof picture.width);
    put(&picture.height, sizeof picture.height);
    putList(picture.rgb);
  }
  put(&notes, sizeof notes);
  for (const std::string& note : read.notes) putList(note);
  return bytes;
}

std::vector<std::uint8_t> errorBytes(const std::string& text) {
  std::vector<std::uint8_t> bytes(1 + text.size(), kError);
  std::copy(text.begin(), text.end(), bytes.begin() + 1);
  return bytes;
}

std::vector<std::uint8_t> refusalBytes(const std::error_code& code) {
  return {kRefused, static_cast<std::uint8_t>(code.value())};
}

ImportedMesh meshOfAnswer(std::span<const std::uint8_t> answer, const std::filesystem::path& path) {
  const std::string place = path.string() + ": ";
  if (!answer.empty() && answer[0] == kError)
    throw InputError(place + std::string(answer.begin() + 1, answer.end()));
  if (answer.size() == 2 && answer[0] == kRefused)
    throw std::system_error(answer[1], std::generic_category(), "cannot read '" + path.string() + "'");
  std::optional<ImportedMesh> mesh;
  if (!answer.empty() && answer[0] == kParts) mesh = AnswerReader(answer.subspan(1)).mesh();
  if (!mesh) throw InputError(place + "cannot be read as a mesh: its reader gave no answer");
  return *std::move(mesh);
}

}  // namespace carom::demos
