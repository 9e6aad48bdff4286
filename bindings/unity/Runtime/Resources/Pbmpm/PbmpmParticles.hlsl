// Particles as the library writes them, and the two triangles that each becomes.
#ifndef PBMPM_PARTICLES
#define PBMPM_PARTICLES

struct PbmpmParticle
{
    float3 position; // [m], from the world's origin
    float3 velocity; // [m/s]
    uint material;   // index of its identifier
};

StructuredBuffer<PbmpmParticle> _PbmpmParticles;
float4 _PbmpmOrigin;
float _PbmpmRadius;
float _PbmpmOnly; // index of the material that is drawn; below 0: all

static const float2 PbmpmCorners[6] = {float2(-1, -1), float2(1, -1), float2(1, 1), float2(-1, -1), float2(1, 1), float2(-1, 1)};

float2 PbmpmCorner(uint vertexId)
{
    return PbmpmCorners[vertexId % 6];
}

float3 PbmpmPlace(uint particle)
{
    return _PbmpmParticles[particle].position + _PbmpmOrigin.xyz;
}

// Where a corner of a particle lies in clip space: behind the far end if its material is not drawn.
float4 PbmpmClip(uint particle, float4 clip)
{
    bool drawn = _PbmpmOnly < 0 || _PbmpmParticles[particle].material == uint(_PbmpmOnly);
    return drawn ? clip : float4(2, 2, 2, 1);
}

// Of a ball, towards the eye, over its square; length above 1: beside the ball.
float PbmpmBulge(float2 corner)
{
    return sqrt(saturate(1 - dot(corner, corner)));
}

#endif
