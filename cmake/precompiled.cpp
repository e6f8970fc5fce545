// Owns the precompiled headers (BerthTargets.cmake), which need a target with a source.
