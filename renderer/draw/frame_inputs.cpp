#include "renderer/draw/frame_inputs.h"

#include <cstddef>

namespace carom::renderer {

std::vector<DrawnBody> drawnBodies(std::span<const DrawGroup> groups,
                                   std::span<const InstanceRecord> records) {
  std::vector<DrawnBody> bodies;
  for (const DrawGroup& group : groups)
    for (const InstanceRecord& record :
         records.subspan(static_cast<std::size_t>(group.first), static_cast<std::size_t>(group.count)))
      bodies.push_back({record, group.range, group.look});
  return bodies;
}

void appendTo(std::vector<DrawGroup>& groups, std::vector<InstanceRecord>& records, const DrawnBody& body) {
  if (groups.empty() || groups.back().look != body.look || !(groups.back().range == body.mesh))
    groups.push_back({body.mesh, body.look, static_cast<int>(records.size()), 0});
  ++groups.back().count;
  records.push_back(body.record);
}

}  // namespace carom::renderer
