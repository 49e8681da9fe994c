#include "demos/asset/mesh_answer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "demos/format/byte_message.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr std::uint8_t kError = 'e', kParts = 'p', kRefused = 'r';

/// Takes the answer apart; nothing where it is no answer, for who wrote it may have gone astray.
class AnswerReader {
 public:
  explicit AnswerReader(std::span<const std::uint8_t> rest) : rest_(rest) {}

  std::optional<ImportedMesh> mesh() {
    ImportedMesh mesh;
    const auto parts = number<std::size_t>();
    if (!parts || *parts > kMostMeshParts) return std::nullopt;
    for (std::size_t i = 0; i < *parts; ++i)
      if (!part(mesh.parts.emplace_back())) return std::nullopt;
    if (!pictures(mesh) || !notes(mesh) || !rest_.empty()) return std::nullopt;
    return mesh;
  }

 private:
  bool part(MeshPart& part) {
    std::vector<Vec3> places;
    const auto isOfEach = [&part](const auto& of_vertices) {
      return of_vertices.empty() || of_vertices.size() == part.vertices.size();
    };
    if (!points<ReadPart::Place>(part.vertices) || !points<ReadPart::Point>(part.normals) ||
        !points<ReadPart::Point>(part.colors) || !points<ReadPart::Point>(places) ||
        !isOfEach(part.normals) || !isOfEach(part.colors) || !isOfEach(places))
      return false;
    for (const Vec3& place : places) part.uv.push_back(place.head<2>());
    const auto triangles = list<ReadPart::Corners>();
    if (!triangles) return false;
    for (const ReadPart::Corners& c : *triangles) {
      if (std::max({c[0], c[1], c[2]}) >= part.vertices.size()) return false;
      part.triangles.push_back({static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2])});
    }
    const auto picture = number<std::int32_t>();
    if (!picture) return false;
    if (*picture >= 0 && !part.uv.empty()) part.picture_of.assign(part.triangles.size(), *picture);
    return true;
  }
  template <typename Written>
  bool points(std::vector<Vec3>& into) {
    const auto written = list<Written>();
    if (!written) return false;
    for (const Written& p : *written) {
      into.emplace_back(p[0], p[1], p[2]);
      if (!into.back().allFinite()) return false;
    }
    return true;
  }
  bool pictures(ImportedMesh& mesh) {
    const auto count = number<std::size_t>();
    if (!count || *count > rest_.size()) return false;
    for (std::size_t k = 0; k < *count; ++k) {
      const auto width = number<int>(), height = number<int>();
      auto rgb = list<std::uint8_t>();
      if (!width || !height || !rgb || *width < 1 || *height < 1 ||
          rgb->size() != 3 * static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height))
        return false;
      mesh.pictures.push_back({*width, *height, *std::move(rgb)});
    }
    for (const MeshPart& part : mesh.parts)
      for (const int picture : part.picture_of)
        if (picture >= static_cast<int>(mesh.pictures.size())) return false;
    return true;
  }
  bool notes(ImportedMesh& mesh) {
    const auto count = number<std::size_t>();
    if (!count || *count > rest_.size()) return false;
    for (std::size_t k = 0; k < *count; ++k) {
      const auto note = list<char>();
      if (!note) return false;
      mesh.notes.emplace_back(note->begin(), note->end());
    }
    return true;
  }
  template <typename Number>
  std::optional<Number> number() {
    Number value{};
    if (rest_.size() < sizeof value) return std::nullopt;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_ = rest_.subspan(sizeof value);
    return value;
  }
  template <typename Item>
  std::optional<std::vector<Item>> list() {
    const auto bytes = number<std::size_t>();
    if (!bytes || *bytes > rest_.size() || *bytes % sizeof(Item) != 0) return std::nullopt;
    std::vector<Item> items(*bytes / sizeof(Item));
    if (!items.empty()) std::memcpy(items.data(), rest_.data(), *bytes);
    rest_ = rest_.subspan(*bytes);
    return items;
  }

  std::span<const std::uint8_t> rest_;
};

template <typename Item>
std::span<const std::uint8_t> bytesOf(const std::vector<Item>& list) {
  return {reinterpret_cast<const std::uint8_t*>(list.data()), list.size() * sizeof(Item)};
}

}  // namespace

ReadPart joinedPart(const ReadPart& part, const std::vector<unsigned>& named) {
  const auto isLess = [&part](unsigned a, unsigned b) {
    if (part.vertices[a] != part.vertices[b]) return part.vertices[a] < part.vertices[b];
    for (const auto* list : {&part.normals, &part.colors, &part.uv})
      if (!list->empty() && (*list)[a] != (*list)[b]) return (*list)[a] < (*list)[b];
    return false;
  };
  std::vector<unsigned> sorted = named, first(part.vertices.size()), number(part.vertices.size());
  std::stable_sort(sorted.begin(), sorted.end(),
                   isLess);  // of what is alike, the first that is named comes first
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
  MessageWriter answer;
  answer.put(kParts).put(read.parts.size());
  for (const ReadPart& part : read.parts) {
    answer.put(bytesOf(part.vertices))
        .put(bytesOf(part.normals))
        .put(bytesOf(part.colors))
        .put(bytesOf(part.uv));
    answer.put(bytesOf(part.triangles)).put(part.picture);
  }
  answer.put(read.pictures.size());
  for (const SurfacePicture& picture : read.pictures)
    answer.put(picture.width).put(picture.height).put(bytesOf(picture.rgb));
  answer.put(read.notes.size());
  for (const std::string& note : read.notes) answer.put(note);
  return std::move(answer).bytes();
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
