s/pbmpm_world_step(pbmpm_world_id world, float dt)/pbmpm_world_step(pbmpm_world_id world, double dt)/
