s/pbmpm_world_wake/pbmpm_world_rouse/
