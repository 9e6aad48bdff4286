s/ int32_t iterations; float gravity/ float iterations; float gravity/
