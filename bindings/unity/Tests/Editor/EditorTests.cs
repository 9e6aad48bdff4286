using System.Threading;
using NUnit.Framework;
using Pbmpm.Components;
using Pbmpm.Editing;
using UnityEngine;

namespace Pbmpm.Tests
{
    /// <summary>What inspectors ask of a scene that does not play.</summary>
    public sealed class EditorTests
    {
        GameObject body;
        PbmpmWorld world;
        PbmpmElastic jelly;

        [SetUp]
        public void SetUp()
        {
            body = new GameObject("world");
            world = body.AddComponent<PbmpmWorld>();
            jelly = ScriptableObject.CreateInstance<PbmpmElastic>();
            jelly.name = "jelly";
            var fill = body.AddComponent<PbmpmFill>();
            fill.material = jelly;
        }

        [TearDown]
        public void TearDown()
        {
            Object.DestroyImmediate(body);
        }

        [Test]
        public void ASceneIsTriedAndLeftAsItWas()
        {
            var trial = SceneTrial.Of(world);
            Assert.AreEqual("", trial.Problem);
            Assert.AreEqual(8000, trial.Particles);
            Assert.Greater(trial.Acting[jelly].YoungModulus, 0);
            Assert.IsTrue(!world.IsOpen && PbmpmWorld.First == null);
            Assert.IsTrue(body.GetComponent<PbmpmFill>().Owner == null);
        }

        [Test]
        public void AdviceIsTheLibrarys()
        {
            world.gravity = Vector3.zero;
            var trial = SceneTrial.Of(world);
            Assert.Greater(trial.Advice.Count, 0);
            Assert.IsTrue(trial.Advice[0].Contains("gravity"));
        }

        [Test]
        public void AMaterialTellsWhatActs()
        {
            Assert.IsTrue(PbmpmMaterialEditor.Ask(jelly).Contains("world: Young's modulus"));
            Assert.IsTrue(PbmpmMaterialEditor.Ask(ScriptableObject.CreateInstance<PbmpmSand>()).Contains("No world"));
        }

        [Test]
        public void AFlawIsTold()
        {
            world.capacity = 10;
            Assert.IsTrue(SceneTrial.Of(world).Problem.Contains("CAPACITY"));
            Assert.IsTrue(!world.IsOpen);
        }

        [Test]
        public void BakingGoesOnBesideTheEditor()
        {
            var solid = ScriptableObject.CreateInstance<PbmpmSolid>();
            var terrain = new TerrainData();
            terrain.size = Vector3.one;
            terrain.SetHeights(0, 0, new float[terrain.heightmapResolution, terrain.heightmapResolution]);
            solid.terrain = terrain;
            solid.resolution = 16;
            var baking = new Baking(solid);
            while (!baking.IsDone)
            {
                Thread.Sleep(1);
                baking.Look();
            }
            Assert.AreEqual("", baking.Problem);
            Assert.IsTrue(solid.IsBaked);
        }

        [Test]
        public void ABakeThatFailsIsTold()
        {
            var baking = new Baking(ScriptableObject.CreateInstance<PbmpmSolid>());
            Assert.IsTrue(baking.IsDone);
            Assert.IsTrue(baking.Problem.Contains("neither a mesh nor a terrain"));
        }
    }
}
