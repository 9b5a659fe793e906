# The project that this one is a folder of links the same names as with the installed package.
add_library(penumbra::penumbra ALIAS penumbra_shared)
add_library(penumbra::static ALIAS penumbra_static)
add_library(penumbra::shadow ALIAS penumbra_extending)
