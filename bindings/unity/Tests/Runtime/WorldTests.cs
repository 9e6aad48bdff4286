using System;
using System.Collections;
using System.Text.RegularExpressions;
using NUnit.Framework;
using Pbmpm.Components;
using UnityEngine;
using UnityEngine.TestTools;

namespace Pbmpm.Tests
{
    public sealed class WorldTests : StageTests
    {
        [UnityTest]
        public IEnumerator FramesTakeSteps()
        {
            stage.AddPool();
            stage.Begin();
            while (stage.World.Statistics.StepCount < 5) yield return null;
            Assert.AreEqual(16384, stage.World.ParticleCount);
            Assert.IsTrue(PbmpmWorld.First == stage.World);
        }

        [Test]
        public void ALongFrameIsCutAndAFineRateIsNot()
        {
            stage.World.rate = 120;
            stage.Begin();
            for (var frame = 0; frame < 50; frame++) stage.World.Advance(0.02f); // 2.4 steps each
            Assert.AreEqual(1, (float)stage.World.Simulation.Stats.SimulatedSeconds, 1 / 120f);
            Assert.AreEqual(0, stage.World.LostTime);
            stage.World.Advance(1);
            Assert.AreEqual(1 - 4 / 120f - 1 / 120f, (float)stage.World.LostTime, 1 / 120f);
        }

        [Test]
        public void PlayingTwiceComesToTheSame()
        {
            var hashes = new ulong[2];
            for (var play = 0; play < 2; play++)
            {
                stage.AddBlock(stage.Water);
                stage.Begin();
                stage.Step(20);
                hashes[play] = stage.World.Simulation.StateHash;
                stage.End();
                Assert.IsTrue(PbmpmWorld.First == null);
                stage = new Stage();
            }
            Assert.AreEqual(hashes[0], hashes[1]);
        }

        [Test]
        public void AWorldThatIsEnabledAgainBeginsAnew()
        {
            stage.AddBlock(stage.Water);
            stage.Begin();
            stage.Step(3);
            var first = stage.World.Simulation.StateHash;
            stage.World.enabled = false;
            Assert.IsTrue(!stage.World.IsOpen);
            Assert.Throws<InvalidOperationException>(() => stage.World.Simulation.Step(1));
            stage.World.enabled = true;
            stage.Step(3);
            Assert.AreEqual(first, stage.World.Simulation.StateHash);
        }

        [Test]
        public void InTheBackgroundItComesToTheSame()
        {
            stage.AddBlock(stage.Water);
            stage.Begin();
            stage.Step(10);
            var here = stage.World.Simulation.StateHash;
            stage.World.enabled = false;
            stage.World.background = true;
            stage.World.enabled = true;
            for (var begun = 0; begun < 10; begun++)
            {
                stage.World.Advance(stage.World.StepSeconds);
                Assert.IsTrue(stage.World.Simulation.ParticleCount > 0); // asking waits
            }
            Assert.AreEqual(10ul, stage.World.Statistics.StepCount);
            Assert.AreEqual(here, stage.World.Simulation.StateHash);
        }

        [Test]
        public void ItMayEndWhileAStepRuns()
        {
            stage.AddPool();
            stage.World.background = true;
            stage.Begin();
            stage.World.Advance(stage.World.StepSeconds);
            stage.World.enabled = false;
            Assert.IsTrue(!stage.World.IsOpen);
        }

        [Test]
        public void ParticlesAreLentUntilTheNextStep()
        {
            stage.AddBlock(stage.Water);
            stage.Begin();
            stage.Step(1);
            var lent = stage.World.Positions;
            var heights = stage.World.Particles(Field.Position, 1);
            var speeds = stage.World.Particles(Field.Velocity, 1);
            var copied = new float[lent.Length * 3];
            stage.World.Simulation.Positions.CopyTo(copied);
            for (var i = 0; i < lent.Length; i++)
            {
                Assert.AreEqual(copied[3 * i], lent[i].x);
                Assert.AreEqual(copied[3 * i + 1], heights[i]);
                Assert.AreEqual(-9.81f / 60, speeds[i], 1e-3f);
            }
            Assert.Throws<ArgumentOutOfRangeException>(() => stage.World.Particles(Field.Mass, 1));
            stage.Step(1);
            Assert.Throws<ObjectDisposedException>(() => Use(lent[0].x + speeds[0]));
        }

        [Test]
        public void PlacesAreFromWhereTheWorldBegan()
        {
            var there = new Vector3(1000, 5, -20);
            stage.World.transform.position = there;
            var fill = stage.AddBlock(stage.Water);
            fill.transform.position = there;
            stage.Begin();
            stage.World.transform.position = Vector3.zero;
            stage.Step(1);
            var sum = Vector3.zero;
            var lent = stage.World.Positions;
            for (var i = 0; i < lent.Length; i++) sum += stage.World.Outward(lent[i]) - there;
            Assert.Less((sum / lent.Length).magnitude, 0.02f);
        }

        [Test]
        public void AFlawedWorldIsToldOfOnce()
        {
            LogAssert.Expect(LogType.Exception, new Regex("cell_size"));
            stage.World.cellSize = -1;
            stage.Begin();
            Assert.IsTrue(!stage.World.enabled);
            stage.Step(2);
        }

        [Test]
        public void AFlawedPartIsToldOfOnceAndTheOthersGoOn()
        {
            LogAssert.Expect(LogType.Exception, new Regex("has no material"));
            var flawed = stage.Add<PbmpmFill>(Vector3.zero);
            stage.AddBlock(stage.Water);
            stage.Begin();
            stage.Step(2);
            Assert.IsTrue(!flawed.enabled && !flawed.IsIn);
            Assert.Greater(stage.World.ParticleCount, 0);
        }

        [Test]
        public void WhatTheLibraryWarnsOfIsTold()
        {
            LogAssert.Expect(LogType.Warning, new Regex("^pbmpm: "));
            stage.World.walls = false;
            stage.AddBlock(stage.Water);
            stage.Begin();
            stage.Step(1);
            // Onto the last cell that there is, and out of it within the next step
            var there = new[] { new Vector3(stage.World.cellSize * Constants.MaxCell - 1, 0, 0) };
            var fast = new[] { new Vector3(200, 0, 0) };
            stage.World.Simulation.AddParticles(stage.World.IdOf(stage.Water), there, fast);
            stage.Step(1);
            Assert.AreEqual(1ul, stage.World.Simulation.Stats.DeletedTotal);
        }

        [Test]
        public void MaterialsMayChange()
        {
            var jelly = ScriptableObject.CreateInstance<PbmpmElastic>();
            stage.AddBlock(jelly);
            stage.Begin();
            stage.Step(1);
            jelly.youngModulus = 2e5f;
            jelly.Change();
            stage.Step(1);
            Assert.AreEqual(2e5f, stage.World.Simulation.GetMaterial(stage.World.IdOf(jelly)).YoungModulus);
        }

        [Test]
        public void APresetReplacesWhatItNames()
        {
            const string text = "{\"format\": \"pbmpm-preset\", \"version\": 1, \"name\": \"a\", \"scene\": \"b\", "
                + "\"settings\": {\"rate_hz\": 120.0, \"iterations\": 8, \"solver\": \"dual\"}, \"machine\": {\"cores\": [1, 2]}}";
            stage.World.preset = new TextAsset(text);
            stage.World.substeps = 3;
            stage.Begin();
            var settings = stage.World.Simulation.Settings;
            Assert.AreEqual(1 / 120f, stage.World.StepSeconds);
            Assert.AreEqual(8, settings.Iterations);
            Assert.AreEqual(3, settings.Substeps);
            Assert.AreEqual(Solver.Dual, settings.Solver);
        }

        [Test]
        public void AnotherFileIsNoPreset()
        {
            LogAssert.Expect(LogType.Exception, new Regex("is no preset"));
            stage.World.preset = new TextAsset("{\"format\": \"pbmpm-scene\"}");
            stage.Begin();
            Assert.IsTrue(!stage.World.IsOpen);
        }

        static void Use(float number)
        {
        }
    }
}
