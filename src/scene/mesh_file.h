// Mesh files of other programs: glTF 2, OBJ, PLY, FBX.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace illum {

/// Whether a file's name ends like that of a mesh file (.gltf, .glb, .obj, .ply, .fbx).
bool isMeshFile(const std::filesystem::path& file);

/// All meshes of a file in its own coordinates, with materials, textures (embedded ones too),
/// vertex colours and the transforms of its nodes. Edges flatter than `smoothDegrees` are smooth
/// where the file has no normals (default: none of glTF, as its standard says, 60 of the others).
/// What is in the file and is not taken over is named in `remarks`, one sentence each. Throws Error
/// naming the file: missing, damaged, empty, or asking for what cannot be ignored. Untrusted input
/// is safe as far as assimp is.
Scene readMeshFile(const std::filesystem::path& file, std::optional<double> smoothDegrees,
                   std::vector<std::string>& remarks);

}  // namespace illum
