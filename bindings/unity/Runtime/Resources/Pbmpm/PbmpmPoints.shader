// Each particle as a ball, in the colour of its material. Its pass has no light mode, which all pipelines draw.
Shader "Pbmpm/Points"
{
    SubShader
    {
        Tags { "RenderType" = "Opaque" "Queue" = "Geometry" }

        Pass
        {
            Cull Off
            ZWrite On

            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex Vertex
            #pragma fragment Fragment
            #include "UnityCG.cginc"
            #include "PbmpmParticles.hlsl"

            float4 _PbmpmColours[256];
            float4 _PbmpmLight;

            struct Sprite
            {
                float4 position : SV_Position;
                float2 corner : TEXCOORD0;
                float3 colour : TEXCOORD1;
            };

            Sprite Vertex(uint vertexId : SV_VertexID, uint particle : SV_InstanceID)
            {
                Sprite sprite;
                sprite.corner = PbmpmCorner(vertexId);
                float3 middle = mul(UNITY_MATRIX_V, float4(PbmpmPlace(particle), 1)).xyz;
                float4 place = float4(middle + float3(sprite.corner * _PbmpmRadius, 0), 1);
                sprite.position = PbmpmClip(particle, mul(UNITY_MATRIX_P, place));
                sprite.colour = _PbmpmColours[_PbmpmParticles[particle].material & 255].rgb;
                return sprite;
            }

            float4 Fragment(Sprite sprite) : SV_Target
            {
                clip(1 - dot(sprite.corner, sprite.corner));
                float3 normal = float3(sprite.corner, PbmpmBulge(sprite.corner));
                float3 light = mul((float3x3)UNITY_MATRIX_V, _PbmpmLight.xyz);
                float lit = 0.35 + 0.65 * saturate(dot(normal, light));
                return float4(sprite.colour * lit, 1);
            }
            ENDHLSL
        }
    }
}
