# The one direction of dependencies: which engine folders a folder may include (besides itself and
# everything those may include). The libraries link by this table and a test greps the includes
# against it, so an arrow is added here or nowhere.
set(VASA_LAYERS core math curve mesh network surface convert body collide avoid growth scene io gpu render)
set(VASA_MAY_INCLUDE_core)
set(VASA_MAY_INCLUDE_math core)
set(VASA_MAY_INCLUDE_curve math)
set(VASA_MAY_INCLUDE_mesh math)
set(VASA_MAY_INCLUDE_network curve)
set(VASA_MAY_INCLUDE_convert network mesh surface)
set(VASA_MAY_INCLUDE_body network mesh)
set(VASA_MAY_INCLUDE_collide network mesh)
set(VASA_MAY_INCLUDE_avoid collide body)
set(VASA_MAY_INCLUDE_surface network)
set(VASA_MAY_INCLUDE_growth surface)
set(VASA_MAY_INCLUDE_io core mesh network body)
set(VASA_MAY_INCLUDE_scene io convert body avoid surface growth)
set(VASA_MAY_INCLUDE_gpu core)
set(VASA_MAY_INCLUDE_render gpu scene surface growth)
