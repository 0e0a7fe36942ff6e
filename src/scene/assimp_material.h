// Materials and textures as assimp hands them over. Only mesh_file.cpp and its own source include
// this header.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

struct aiScene;

namespace illum {

/// Adds the file's materials, in its order, and the textures that they use to `scene`. A texture
/// that cannot be found is named in a remark; one that cannot be decoded is an Error.
void addMaterials(const aiScene& from, const std::filesystem::path& file, Scene& scene,
                  std::vector<std::string>& remarks);

}  // namespace illum
