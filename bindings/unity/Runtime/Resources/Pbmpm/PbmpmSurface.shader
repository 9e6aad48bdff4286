// Liquid as a surface in screen space. It needs nothing of a pipeline but the depth texture of the camera.
Shader "Hidden/Pbmpm/Surface"
{
    HLSLINCLUDE
    #pragma target 4.5
    #include "PbmpmParticles.hlsl"

    float4x4 _PbmpmView, _PbmpmProjection, _PbmpmUnprojection;

    struct Sprite
    {
        float4 position : SV_Position;
        float2 corner : TEXCOORD0;
        float depth : TEXCOORD1; // of the middle, from the eye [m]
    };

    struct Screen
    {
        float4 position : SV_Position;
    };

    Sprite Splat(uint vertexId : SV_VertexID, uint particle : SV_InstanceID)
    {
        Sprite sprite;
        sprite.corner = PbmpmCorner(vertexId);
        float3 middle = mul(_PbmpmView, float4(PbmpmPlace(particle), 1)).xyz;
        sprite.depth = -middle.z;
        sprite.position = PbmpmClip(particle, mul(_PbmpmProjection, float4(middle + float3(sprite.corner * _PbmpmRadius, 0), 1)));
        return sprite;
    }

    // One triangle that covers the screen.
    Screen Cover(uint vertexId : SV_VertexID)
    {
        Screen screen;
        screen.position = float4(vertexId == 1 ? 3.0 : -1.0, vertexId == 2 ? 3.0 : -1.0, 0.5, 1);
        return screen;
    }
    ENDHLSL

    SubShader
    {
        Cull Off
        ZWrite Off
        ZTest Always

        Pass // 0: how far the nearest ball is from the eye
        {
            BlendOp Min
            Blend One One

            HLSLPROGRAM
            #pragma vertex Splat
            #pragma fragment Depth

            float4 Depth(Sprite sprite) : SV_Target
            {
                clip(1 - dot(sprite.corner, sprite.corner));
                return float4(sprite.depth - PbmpmBulge(sprite.corner) * _PbmpmRadius, 0, 0, 1);
            }
            ENDHLSL
        }

        Pass // 1: how much liquid lies behind each other
        {
            Blend One One

            HLSLPROGRAM
            #pragma vertex Splat
            #pragma fragment Thickness

            float4 Thickness(Sprite sprite) : SV_Target
            {
                clip(1 - dot(sprite.corner, sprite.corner));
                return float4(2 * PbmpmBulge(sprite.corner) * _PbmpmRadius, 0, 0, 1);
            }
            ENDHLSL
        }

        Pass // 2: a bilateral filter along one axis: even, but not over edges
        {
            HLSLPROGRAM
            #pragma vertex Cover
            #pragma fragment Smooth

            Texture2D<float> _PbmpmSource;
            float4 _PbmpmAxis;

            static const int Reach = 6; // [pixels] to each side

            float4 Smooth(Screen screen) : SV_Target
            {
                int2 here = int2(screen.position.xy);
                float middle = _PbmpmSource.Load(int3(here, 0));
                float sum = 0, weights = 0;
                for (int i = -Reach; i <= Reach; i++)
                {
                    float depth = _PbmpmSource.Load(int3(here + i * int2(_PbmpmAxis.xy), 0));
                    float across = i / (0.5 * Reach), along = (depth - middle) / _PbmpmRadius;
                    float weight = exp(-0.5 * (across * across + along * along));
                    sum += weight * depth;
                    weights += weight;
                }
                return float4(sum / weights, 0, 0, 1);
            }
            ENDHLSL
        }

        Pass // 3: normals, light and tint over the picture
        {
            Blend SrcAlpha OneMinusSrcAlpha

            HLSLPROGRAM
            #pragma vertex Cover
            #pragma fragment Compose

            Texture2D<float> _PbmpmDepths;
            Texture2D<float> _PbmpmThickness;
            Texture2D<float> _CameraDepthTexture;
            float4 _PbmpmTint, _PbmpmLight;
            float _PbmpmClarity, _PbmpmFlip;

            static const float Nothing = 1e5; // [m], as far as no liquid is

            // Where a pixel with a value of the depth texture lies in clip space. OpenGL counts its rows from below, and its depths from -1.
            float4 Clip(int2 pixel, float2 size, float depth)
            {
                float2 place = (float2(pixel) + 0.5) / size * 2 - 1;
            #if defined(SHADER_API_GLCORE) || defined(SHADER_API_GLES3)
                return float4(place, 2 * depth - 1, 1);
            #else
                return float4(place.x, -place.y, depth, 1);
            #endif
            }

            // The point of the surface in the eye's frame.
            float3 Point(int2 pixel, float2 size)
            {
                float4 ray = mul(_PbmpmUnprojection, Clip(pixel, size, 0.5));
                return ray.xyz / -ray.z * _PbmpmDepths.Load(int3(pixel, 0));
            }

            // Of the scene that is drawn already, from the eye [m].
            float SceneDepth(int2 pixel, float2 size)
            {
                float4 place = mul(_PbmpmUnprojection, Clip(pixel, size, _CameraDepthTexture.Load(int3(pixel, 0))));
                return -place.z / place.w;
            }

            // Of the two neighbours the nearer one, so that edges stay sharp.
            float3 Slope(float3 here, float3 before, float3 after)
            {
                return abs(after.z - here.z) < abs(here.z - before.z) ? after - here : here - before;
            }

            float4 Compose(Screen screen) : SV_Target
            {
                float2 size;
                _PbmpmDepths.GetDimensions(size.x, size.y);
                int2 here = int2(screen.position.xy);
                if (_PbmpmFlip > 0.5) here.y = int(size.y) - 1 - here.y;
                float depth = _PbmpmDepths.Load(int3(here, 0));
                if (depth > Nothing || depth > SceneDepth(here, size)) discard;

                float3 middle = Point(here, size);
                float3 right = Slope(middle, Point(here - int2(1, 0), size), Point(here + int2(1, 0), size));
                float3 up = Slope(middle, Point(here - int2(0, 1), size), Point(here + int2(0, 1), size));
                float3 normal = normalize(cross(right, up));
                float3 eye = normalize(-middle);
                if (dot(normal, eye) < 0) normal = -normal;

                // Schlick's formula, with the reflectance of water; Blinn's highlight; Beer's law
                float fresnel = 0.02 + 0.98 * pow(1 - saturate(dot(normal, eye)), 5);
                float shine = pow(saturate(dot(normal, normalize(eye + normalize(_PbmpmLight.xyz)))), 100);
                float lit = 0.5 + 0.5 * saturate(dot(normal, _PbmpmLight.xyz));
                float opacity = 1 - exp(-_PbmpmThickness.Load(int3(here, 0)) / _PbmpmClarity);
                float3 colour = lerp(_PbmpmTint.rgb * lit, float3(0.8, 0.9, 1), fresnel) + shine;
                return float4(colour, saturate(max(opacity, fresnel) + shine));
            }
            ENDHLSL
        }
    }
}
