s/world_id { uint32_t index; uint32_t generation; }/world_id { uint32_t index; uint32_t generation; uint32_t more; }/
