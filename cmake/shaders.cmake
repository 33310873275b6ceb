# Filled by the gpu layer: compiles shaders/*.comp|vert|frag to SPIR-V and embeds them.
