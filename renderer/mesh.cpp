// SPDX-License-Identifier: Apache-2.0
// Triangle meshes, read by Assimp.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>

#include "renderer/scene_node.h"

namespace mms::renderer {
namespace {

std::string extension_of(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

Vec3d vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Appends one of a file's meshes; false if it holds what is not finite.
bool append(const aiMesh& from, const Transform& transform, bool normals, bool uvs, Mesh& mesh) {
  const auto base = std::uint32_t(mesh.positions.size());
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    const Vec3f p(transform.point(vec(from.mVertices[i])));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
    mesh.positions.push_back(p);
    if (normals) mesh.normals.emplace_back(transform.direction(vec(from.mNormals[i])));
    if (uvs) mesh.uvs.push_back({from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y});
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& f = from.mFaces[i];
    if (f.mNumIndices != 3) continue;
    const std::array<std::uint32_t, 3> t{base + f.mIndices[0], base + f.mIndices[1],
                                         base + f.mIndices[2]};
    const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    if (length(cross(b - a, c - a)) > 0) mesh.triangles.push_back(t);  // a sliver has no normal
  }
  return true;
}

}  // namespace

Result<Mesh> load_mesh(const std::string& path, const Transform& transform) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return no_file("mesh", path);
  const std::string extension = extension_of(path);
  if (extension != ".obj" && extension != ".ply")
    return Error{path, "unsupported mesh type `" + extension + "`", "supported: .obj, .ply"};
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                  aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (!scene || !scene->HasMeshes())
    return Error{path, std::string("cannot read the mesh: ") + importer.GetErrorString(),
                 "is it whole, with faces, and of the kind that its name says?",
                 Error::Cause::File};
  bool normals = true, uvs = true;  // kept only if all parts have them
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    normals &= scene->mMeshes[i]->HasNormals();
    uvs &= scene->mMeshes[i]->HasTextureCoords(0);
  }
  Mesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i)
    if (!append(*scene->mMeshes[i], transform, normals, uvs, mesh))
      return Error{path, "a vertex of the mesh is not finite", ""};
  if (mesh.triangles.empty()) return Error{path, "the mesh has no triangle", ""};
  return mesh;
}

}  // namespace mms::renderer
