s/uint32_t size; int32_t substeps;/uint32_t size; int32_t moved; int32_t substeps;/
