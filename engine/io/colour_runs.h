#pragma once
#include <span>

#include "mesh/mesh_element.h"

namespace vasa {

/// What the triangles from `first` to `end` are drawn with, where vertices have colours: a run for each
/// stretch of triangles of one colour (their first corners' tell), or where there are more than 64 of them
/// one with their mean, as shading by vertices says nothing else.
/// @param base      the material's name, and its colour, which multiplies the vertices'
/// @param colours   linear; of the vertices from `firstVertex` on
void addColourRuns(const TriangleMesh& mesh, std::uint32_t first, std::size_t end,
                   std::span<const vec3> colours, std::size_t firstVertex, const MeshMaterial& base,
                   std::vector<MeshMaterial>& materials);

}  // namespace vasa
